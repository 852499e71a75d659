"""Each kind of fault, a few times; `make torture` runs longer. Those of the disk have a test in `cli`."""

from random import Random

import pytest

from python.thorough import some
from python.torture import faults
from python.torture.kinds import KINDS


@pytest.mark.parametrize("seed", some(range(5)))
@pytest.mark.parametrize("kind", [kind for kind in KINDS if KINDS[kind] != faults.once])
def test_nothing_is_lost(kind, seed, tmp_path):
    assert KINDS[kind](Random(seed), tmp_path) > 0
