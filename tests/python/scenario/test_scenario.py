from dataclasses import replace
from typing import Any

import pytest


@pytest.mark.parametrize("wrong", ["3", None, 0, -1.0, float("nan"), float("inf"), 9_200_001])
def test_a_script_may_not_replace_the_time_limit_by_none(folder: Any, wrong: Any) -> None:
    with pytest.raises(ValueError, match=r"^sim_time_limit_s "):
        replace(folder.load(), sim_time_limit_s=wrong)


def test_a_script_may_not_leave_a_gap_in_the_ids_of_nodes(folder: Any) -> None:
    scenario = folder.load()
    with pytest.raises(ValueError, match=r"^nodes: uavs\[1\], .* 1, .* 2; "):
        replace(scenario, nodes=scenario.nodes[::2])
