"""The values in docs/reference/values.md work with the example of the guides; its tables are complete."""

import re
from collections.abc import Callable
from math import hypot
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

import gradysim.integrated.run
from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.parse.distributions import DISTRIBUTIONS
from gradysim.scenario.parse.expressions import SELECT_WRITTEN
from gradysim.scenario.parse.functions import FUNCTIONS, OPERATORS

GUIDE = "docs/reference/values.md"
EXAMPLE = "docs/reference/example.md"


@pytest.fixture
def scenarios(
    code_blocks: Callable[[str, str], list[str]], tmp_path: Path
) -> Callable[[str], list[Scenario]]:
    """Load a configuration of the example with additional configurations of this page."""
    (tmp_path / "hello.py").write_text(code_blocks(EXAMPLE, "python")[0], encoding="utf-8")
    text = [code_blocks(EXAMPLE, "ini")[0], *code_blocks(GUIDE, "ini")]
    (tmp_path / "hello.ini").write_text("\n".join(text), encoding="utf-8")
    return lambda config: load_scenarios(tmp_path / "hello.ini", config)


def test_its_circle_has_4_and_12_nodes(scenarios: Callable[[str], list[Scenario]]) -> None:
    few, many = scenarios("Circle")
    assert [len(scenario.nodes) for scenario in (few, many)] == [4, 12]
    assert all(abs(hypot(x, y) - 40) < 1e-4 for x, y, _ in (node.initial_position for node in many.nodes))
    assert [scenario.nodes[0].protocol_parameters["jitter"] for scenario in (few, many)] == [0.05, 0.2]
    powers = [node.wlan[0].radio["tx_power_w"].value for node in many.nodes[:3]]
    assert powers == pytest.approx([0.001, 0.002, 0.001])


def test_its_random_places_are_others_in_each_run(scenarios: Callable[[str], list[Scenario]]) -> None:
    scattered = scenarios("Scattered")
    places = [node.initial_position for scenario in scattered for node in scenario.nodes]
    assert len(set(places)) == len(places) == 10 * 4
    assert all(0 <= x < 500 and 0 <= y < 500 and z >= 5 for x, y, z in places)
    heard = [node.tracked_variables["heard"] for node in gradysim.integrated.run.run(scattered[0]).nodes]
    assert any(heard)


def functions_in(table: str) -> list[str]:
    return re.findall(r"`(\w+\(.*?\))`", "\n".join(re.findall(r"^\| (.*?) \|", table, re.MULTILINE)))


def test_its_tables_have_all_functions(root: Path) -> None:
    _, pure, drawing = (root / GUIDE).read_text().split("| function |")
    pure = pure.partition("## ")[0]
    assert sorted(functions_in(pure)) == sorted(
        [SELECT_WRITTEN, *(written for written, _ in FUNCTIONS.values())]
    )
    drawn = functions_in(drawing.partition("All values")[0])
    assert drawn == [function.written for function in DISTRIBUTIONS.values()]


def test_its_table_has_all_operators(root: Path) -> None:
    table = (root / GUIDE).read_text().partition("| operators")[2].partition("\n\n")[0].replace("\\|", "|")
    shown = re.findall(r"`([^`]*)`", "\n".join(row.split(" | ")[0] for row in table.splitlines()[2:]))
    assert shown[:3] == ["-x", "!x", "^"]
    assert shown[-1] == "a ? b : c"
    assert shown[3:-1] == sorted(
        OPERATORS, key=lambda sign: (-OPERATORS[sign].level, [*OPERATORS].index(sign))
    )
