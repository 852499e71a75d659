from dataclasses import replace
from typing import Any

import pytest

from gradysim.scenario import load_scenarios


@pytest.mark.parametrize("wrong", ["3", 3.0])
def test_a_seed_that_is_no_whole_number(folder: Any, wrong: Any) -> None:
    scenario = folder.load("")
    with pytest.raises(TypeError, match=f"seed = {wrong!r}: expected a whole number"):
        load_scenarios(folder.ini, seed=wrong)
    with pytest.raises(TypeError, match=f"seed = {wrong!r}: expected a whole number"):
        replace(scenario, seed=wrong)


@pytest.mark.parametrize("wrong", [-1, 2**63])
def test_a_seed_that_is_out_of_range(folder: Any, wrong: int) -> None:
    scenario = folder.load("")
    with pytest.raises(ValueError, match=f"^seed = {wrong}: it is out of range; expected 0 to {2**63 - 1}$"):
        load_scenarios(folder.ini, seed=wrong)
    with pytest.raises(ValueError, match=f"^seed = {wrong}: it is out of range; expected 0 to {2**63 - 1}$"):
        replace(scenario, seed=wrong)
