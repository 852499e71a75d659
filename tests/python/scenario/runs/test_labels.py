from typing import Any

import pytest

from gradysim.scenario import load_scenarios

VARIABLES = ("seedset", "experiment", "measurement", "replication")


def variables(folder: Any, added: str = "") -> list[tuple[str, ...]]:
    folder.load(added)
    scenarios = load_scenarios(folder.ini)
    return [tuple(scenario.variables[name] for name in VARIABLES) for scenario in scenarios]


def test_what_they_are_unless_the_file_says_otherwise(folder: Any) -> None:
    assert variables(folder, "repeat = 2\n**.speed = ${v=3, 4}mps\n") == [
        ("0", "General", "$v=3", "#0"),
        ("1", "General", "$v=3", "#1"),
        ("2", "General", "$v=4", "#0"),
        ("3", "General", "$v=4", "#1"),
    ]


def test_labels_need_no_quotes_and_may_name_variables(folder: Any) -> None:
    added = """**.speed = ${v=3}mps
experiment-label = speeds of ${network}
measurement-label = "${experiment}: ${v}"
replication-label = seed ${seedset}
"""
    assert variables(folder, added) == [("0", "speeds of Network", "speeds of Network: 3", "seed 0")]


def test_the_seed_is_that_of_the_run(folder: Any) -> None:
    folder.load("seed-set = 7 + ${repetition}\n")
    assert load_scenarios(folder.ini)[0].variables["seedset"] == "7"
    assert load_scenarios(folder.ini, seed=40)[0].variables["seedset"] == "40"


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ("seed-set = ${seedset}", "seedset"),
        ("seed-set = ${replication}", "replication"),
        ("experiment-label = ${measurement}", "measurement"),
        ('replication-label = "a ${replication}"', "replication"),
    ],
)
def test_none_may_follow_from_itself(folder: Any, line: str, name: str) -> None:
    assert f"{line}: `${{{name}}}` follows from this value" in folder.error(f"{line}\n")


def test_values_may_name_them(folder: Any) -> None:
    added = 'experiment-label = far\nseed-set = 5\n**.label = "${experiment} ${seedset}"\n'
    _, node, _ = folder.load(added).nodes
    assert node.protocol_parameters["label"] == "far 5"


def test_a_label_that_does_not_end_is_refused(folder: Any) -> None:
    assert "experiment-label" in folder.error('experiment-label = "a" b\n')
