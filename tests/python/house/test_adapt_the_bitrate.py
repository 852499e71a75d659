"""The commands of docs/how-to/adapt-the-bitrate.md run, and its nodes use several rates."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.integrated.run import run
from gradysim.scenario import load_scenarios
from gradysim.scenario.schema.keys import engine_key


@pytest.fixture
def guide(root: Path) -> str:
    return (root / "docs/how-to/adapt-the-bitrate.md").read_text(encoding="utf-8")


@pytest.fixture
def scenario_file(guide: str, tmp_path: Path) -> Path:
    """Return the .ini file of a reader who saved the guide's two files."""
    for language, name in [("python", "rates.py"), ("ini", "rates.ini")]:
        (block,) = re.findall(rf"^```{language}\n(.*?)^```", guide, re.MULTILINE | re.DOTALL)
        (tmp_path / name).write_text(block, encoding="utf-8")
    return tmp_path / "rates.ini"


def test_its_commands_print_the_frames_by_bitrate(
    guide: str, scenario_file: Path, shell: Callable[[str, Path], str], shows: Callable[..., None]
) -> None:
    (commands,) = re.findall(r"^```sh\n(.*?)^```", guide, re.MULTILINE | re.DOTALL)
    shows("docs/how-to/adapt-the-bitrate.md", shell(commands, scenario_file.parent))


def test_the_rate_falls_on_the_way(scenario_file: Path) -> None:
    (scenario,) = load_scenarios(scenario_file)
    uav, ground_station = run(scenario).nodes
    frames = uav.frames_by_bitrate
    assert frames[54_000_000] > 100
    assert frames[12_000_000] > 100
    assert sum(ground_station.frames_by_bitrate.values()) == 0


RATE_CONTROLS = list(engine_key("mac.rate_control").kind.names)


@pytest.mark.parametrize("typename", RATE_CONTROLS)
def test_every_rate_control_is_in_its_table_and_works(guide: str, scenario_file: Path, typename: str) -> None:
    assert f'| `"{typename}"` |' in guide
    settings = [f'**.rateControl.typename = "{typename}"', "sim-time-limit = 1s"]
    (scenario,) = load_scenarios(scenario_file, overrides=settings)
    assert run(scenario).outcomes["messages"]["unicast"]["acknowledged"] > 90
