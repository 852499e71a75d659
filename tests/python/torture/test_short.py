"""Each kind of fault, a few times; `make torture` runs longer. Those of the disk have a test in `cli`."""

from random import Random

import pytest

from python.thorough import some
from python.torture import faults
from python.torture.kinds import KINDS

CASES = {f"{kind}: {harmed}": once for kind in KINDS for harmed, once in KINDS[kind].items()}


@pytest.mark.parametrize("seed", some(range(5)))
@pytest.mark.parametrize("case", [case for case in CASES if CASES[case] not in faults.ONCE.values()])
def test_nothing_is_lost(case, seed, tmp_path):
    assert CASES[case](Random(seed), tmp_path) > 0
