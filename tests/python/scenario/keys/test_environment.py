import pytest

from gradysim.scenario.keys.environment import OBSTACLE_KEYS, obstacle_path


@pytest.mark.parametrize("index", [0, 12])
def test_every_obstacle_has_keys_of_its_own(index: int) -> None:
    paths = {obstacle_path(key, index) for key in OBSTACLE_KEYS}
    assert len(paths) == len(OBSTACLE_KEYS)
    assert all(path.startswith(f"environment.obstacle[{index}].") for path in paths)
