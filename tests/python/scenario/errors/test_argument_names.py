"""What messages about the arguments of `load_scenarios` begin with: as the caller calls them."""

from typing import Any

import pytest

from gradysim.scenario import load_scenarios
from gradysim.scenario.errors.argument_names import ArgumentNames
from gradysim.scenario.errors.config_error import ConfigError

NO_SUCH = {"overrides": ["*.numUavs=two"], "seed": -1, "runs": "x"}


def message(folder: Any, argument: str, **names: ArgumentNames) -> str:
    with pytest.raises(ConfigError) as caught:
        load_scenarios(folder.ini, **{argument: NO_SUCH[argument]}, **names)
    return str(caught.value)


@pytest.mark.parametrize(
    ("argument", "beginning"),
    [("overrides", "override *.numUavs=two: "), ("seed", "seed = -1: "), ("runs", "runs = x: ")],
)
def test_a_script_reads_of_its_arguments(folder: Any, argument: str, beginning: str) -> None:
    assert message(folder, argument).startswith(beginning)


@pytest.mark.parametrize(
    ("argument", "beginning"),
    [("overrides", "-o *.numUavs=two: "), ("seed", "-s -1: "), ("runs", "-n x: ")],
)
def test_others_read_of_theirs(folder: Any, argument: str, beginning: str) -> None:
    assert message(folder, argument, names=ArgumentNames("-o", "-s", "-n", "-c")).startswith(beginning)


def test_another_configuration_is_asked_for_by_the_name_that_the_argument_has(folder: Any) -> None:
    folder.write("test.ini", "sim-time-limit = 1s\n[X]\n*.uavs.count = 2\n")
    with pytest.raises(ConfigError, match=r"of the file: `config = NAME`, X$"):
        load_scenarios(folder.ini)
