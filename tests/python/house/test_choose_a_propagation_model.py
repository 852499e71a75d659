"""The engine accepts the lines in docs/how-to/choose-a-propagation-model.md."""

import math
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.engine_keys import Key
from gradysim.scenario.schema.keys import MATERIALS, OBSTACLE_LOSS_KEYS, PATH_LOSS_KEYS, engine_key


def test_its_lines_run(
    code_blocks: Callable[[str, str], list[str]], make_scenario: Callable[..., Scenario]
) -> None:
    pytest.importorskip("gradysim._netsim")
    from gradysim.integrated.run import run

    fading, antennas, obstacles = (
        make_scenario("class Tested(Talker): pass", *block.strip().splitlines())
        for block in code_blocks("docs/how-to/choose-a-propagation-model.md", "ini")
    )
    assert set(fading.medium) >= {"path_loss", "k_db", "shadowing_standard_deviation_db"}
    assert antennas.nodes[0].wlan[0].antenna["typename"].value == "ParabolicAntenna"
    assert len(obstacles.obstacles) == 2
    for scenario in (fading, antennas, obstacles):
        assert run(scenario).outcomes["messages"]["broadcast"]["sent"] > 0


@pytest.fixture
def guide(root: Path) -> str:
    return (root / "docs/how-to/choose-a-propagation-model.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("key", [PATH_LOSS_KEYS[0], engine_key("antenna.typename"), OBSTACLE_LOSS_KEYS[0]])
def test_every_model_has_a_row(guide: str, key: Key) -> None:
    rows = re.findall(r'^\| `"?(\w*)"?` \|', guide, re.MULTILINE)
    assert set(re.findall(r'"([^"]*)"', key.kind.expected)) - set(rows) == set()


def test_every_material_is_named(guide: str) -> None:
    assert f"P.2040-3: {', '.join(MATERIALS)}." in " ".join(guide.split())


def test_grounds_reflect_as_its_table_says(guide: str) -> None:
    rows = re.findall(r"^\| .* \| ([\d.]+) \| (\d+) % \|$", guide, re.MULTILINE)
    assert len(rows) == 4
    sine, cosine = math.sin(math.radians(10)), math.cos(math.radians(10))
    for permittivity, percent in rows:
        refracted = math.sqrt(float(permittivity) - cosine**2)  # Rappaport, Wireless Communications
        assert round(100 * abs((sine - refracted) / (sine + refracted))) == int(percent)
    default = next(key for key in PATH_LOSS_KEYS if key.path.endswith("epsilon_r")).default
    assert f"an `epsilon_r` of {default}" in guide
