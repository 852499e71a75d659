"""The output in docs/how-to/calibrate-a-range.md is the output of the command."""

import re
import shlex
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.cli.app import main
from gradysim.integrated.calibration import calibrate
from gradysim.scenario import Scenario, load_scenarios


@pytest.fixture
def guide(root: Path) -> str:
    return (root / "docs/how-to/calibrate-a-range.md").read_text(encoding="utf-8")


def test_the_command_prints_what_it_shows(
    root: Path,
    guide: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    shows: Callable[..., None],
) -> None:
    command, *_ = re.findall(r"^```sh\ngradysim (.*)\n```", guide, re.MULTILINE)
    monkeypatch.chdir(root)
    assert main(command.split()) == 0
    printed = capsys.readouterr().out
    shows("docs/how-to/calibrate-a-range.md", printed, part=True)
    assert "   100 m     0.00 %" in printed


@pytest.mark.parametrize(("number", "name"), [(1, "powers.csv"), (2, "frames.csv")])
def test_its_measurements_are_fitted_as_it_shows(
    root: Path,
    guide: str,
    code_blocks: Callable[[str, str], list[str]],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    shows: Callable[..., None],
    number: int,
    name: str,
) -> None:
    command = re.findall(r"^```sh\ngradysim (.*)\n```", guide, re.MULTILINE)[number]
    file = tmp_path / name
    file.write_text(code_blocks("docs/how-to/calibrate-a-range.md", "text")[2 * number - 1])
    arguments = shlex.split(command.replace(name, str(file)).replace("configs", f"{root}/configs"))
    assert main(arguments) == 0
    shows("docs/how-to/calibrate-a-range.md", capsys.readouterr().out, 2 * number)


def test_without_matplotlib_a_picture_is_a_mistake_that_says_how_to_get_it(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    arguments = f"calibrate {root}/configs/zigzag.ini -c ZigZag5 --range 50m --picture curve.svg"
    assert main(arguments.split()) == 2
    assert "pip install matplotlib" in capsys.readouterr().err


def test_a_mistake_is_told_with_its_option(root: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(f"calibrate {root}/configs/zigzag.ini -c ZigZag5 --range 50x".split()) == 2
    assert "--range 50x" in capsys.readouterr().err


def test_its_line_is_understood(root: Path, guide: str) -> None:
    (line,) = re.findall(r"^```ini\n(.*)\n```", guide, re.MULTILINE)
    scenario = load_scenarios(root / "configs/zigzag.ini", "ZigZag5", overrides=[line])[0]
    assert all(node.wlan[0].range_sets_power for node in scenario.nodes)


def test_bitrates_matter_with_the_lines_that_let_the_noise_decide_and_not_without(
    guide: str, make_scenario: Callable[..., Scenario]
) -> None:
    (lines,) = re.findall(r"^```ini\n(.*\n.*)\n```", guide, re.MULTILINE)

    def power_w(mbps: int, *settings: str) -> float:
        bitrate = f"**.wlan[*].bitrate = {mbps}Mbps"
        return calibrate(make_scenario("class Tested(Talker): pass", bitrate, *settings), 100).tx_power_w

    assert power_w(6) == pytest.approx(power_w(54))
    assert power_w(6, *lines.splitlines()) < power_w(54, *lines.splitlines()) / 10
