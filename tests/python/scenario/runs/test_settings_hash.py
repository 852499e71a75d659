from typing import Any

import pytest

from gradysim.scenario import load_scenarios


def hash_of(folder: Any, added: str = "", *overrides: str) -> str:
    text: str = folder.load(added, "General", *overrides).settings_hash
    return text


def test_it_is_that_of_the_same_settings(folder: Any) -> None:
    assert hash_of(folder, "# a comment\n\n**.speed   =  3mps\n") == hash_of(folder, "**.speed = 3mps\n")


@pytest.mark.parametrize(
    "other", [[], ["**.speed=4mps"], ['**.label="3mps"'], ["sim-time-limit=5s", "**.speed=3mps"]]
)
def test_other_settings_have_another(folder: Any, other: list[str]) -> None:
    assert hash_of(folder, "", *other) != hash_of(folder, "", "**.speed=3mps")


def test_the_same_value_of_another_key_has_another(folder: Any) -> None:
    assert hash_of(folder, "", "**.initialX=3m") != hash_of(folder, "", "**.initialY=3m")


@pytest.mark.parametrize(
    "added",
    [
        "repeat = 3\n",
        "description = again\n",
        "network = Network\n",
        "*.visualizer.x = 3\n",
        "constraint = 1 < 2\n",
        "iteration-nesting-order = *\n",
    ],
)
def test_what_no_run_depends_on_does_not_count(folder: Any, added: str) -> None:
    assert hash_of(folder, added) == hash_of(folder)


def test_an_overridden_line_does_not_count(folder: Any) -> None:
    assert hash_of(folder, "**.speed = 4mps\n", "**.speed=3mps") == hash_of(folder, "", "**.speed=3mps")


def test_runs_of_different_values_have_different_ones(folder: Any) -> None:
    folder.load("repeat = 2\n**.speed = ${3, 4}mps\n")
    first, again, other, _ = (scenario.settings_hash for scenario in load_scenarios(folder.ini))
    assert first == again != other


def test_repetitions_with_values_of_their_own_have_different_ones(folder: Any) -> None:
    folder.load("repeat = 2\n**.speed = ${3, 4 ! repetition}mps\n")
    assert len({scenario.settings_hash for scenario in load_scenarios(folder.ini)}) == 2


def test_repetitions_have_the_same_whatever_depends_on_their_number(folder: Any) -> None:
    folder.load('repeat = 2\nseed-set = ${repetition}\n**.label = "${runnumber}"\n')
    first, again = (scenario.settings_hash for scenario in load_scenarios(folder.ini))
    assert first == again


def test_repetitions_have_the_same_whatever_label_depends_on_their_number(folder: Any) -> None:
    labels = 'measurement-label = "m ${seedset}"\nreplication-label = "r" + string(${runnumber})\n'
    folder.load(f'repeat = 2\n{labels}**.label = "${{measurement}} ${{replication}}"\n')
    first, again = (scenario.settings_hash for scenario in load_scenarios(folder.ini))
    assert first == again


@pytest.mark.parametrize("name", ["experiment", "measurement", "replication"])
def test_another_label_is_another_setting_if_a_value_names_it(folder: Any, name: str) -> None:
    added = f'**.label = "${{{name}}}"\n'
    assert hash_of(folder, added, f"{name}-label=a") != hash_of(folder, added, f"{name}-label=b")


def test_another_label_is_none_if_no_value_names_it(folder: Any) -> None:
    assert hash_of(folder, "", "replication-label=a") == hash_of(folder, "", "replication-label=b")
