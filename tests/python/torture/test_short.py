"""Each kind of fault, a few times; `make torture` runs longer."""

from random import Random

import pytest

from python.thorough import some
from python.torture.kinds import KINDS


@pytest.mark.parametrize("seed", some(range(5)))
@pytest.mark.parametrize("kind", KINDS)
def test_nothing_is_lost(kind, seed, tmp_path):
    assert KINDS[kind](Random(seed), tmp_path) > 0
