"""The scenario and the engine agree with docs/how-to/use-several-radios.md."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.integrated.run import run
from gradysim.scenario import load_scenarios


@pytest.fixture
def guide(root: Path) -> str:
    return (root / "docs/how-to/use-several-radios.md").read_text(encoding="utf-8")


def test_its_command_prints_what_it_shows(
    root: Path,
    code_blocks: Callable[[str, str], list[str]],
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
) -> None:
    page = "docs/how-to/use-several-radios.md"
    (command,) = code_blocks(page, "sh")
    shows(page, shell(command, root), part=True)


def test_its_ini_lines_are_those_of_the_scenario(guide: str, root: Path) -> None:
    (block,) = re.findall(r"^```ini\n(.*?)^```", guide, re.MULTILINE | re.DOTALL)
    scenario = (root / "configs/sensor_field.ini").read_text(encoding="utf-8").splitlines()
    assert [line for line in block.splitlines() if line not in scenario] == []


def test_its_commands_are_understood(guide: str) -> None:
    (block,) = re.findall(r"^```python\n(.*?)^```", guide, re.MULTILINE | re.DOTALL)
    names: dict[str, object] = {}
    exec(block, names)
    commands = [names[name] for name in ("by_the_first", "by_the_second", "to_all_by_the_second")]
    assert [command.interface for command in commands] == [0, 1, 1]  # type: ignore[attr-defined]


def test_its_figures_are_those_of_the_run(guide: str, root: Path) -> None:
    ((lost, sent),) = re.findall(r"(\d+) of (\d+) frames to the ground station are\slost", guide)
    (scenario,) = load_scenarios(root / "configs/sensor_field.ini", "SharedSpectrum")
    outcomes = run(scenario).outcomes["frames"]["unicast"]
    assert (outcomes["interference"], sum(outcomes.values())) == (int(lost), int(sent))
