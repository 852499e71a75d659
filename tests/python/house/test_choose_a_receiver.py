"""The file and the lines in docs/how-to/choose-a-receiver.md are valid."""

import math
import re
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

import gradysim.integrated.run
from gradysim.integrated.calibration import calibrate
from gradysim.integrated.network_lint import lint_networks
from gradysim.scenario import load_scenarios


@pytest.fixture
def guide(root: Path) -> str:
    return (root / "docs/how-to/choose-a-receiver.md").read_text(encoding="utf-8")


def test_its_command_prints_what_it_shows(
    root: Path,
    code_blocks: Callable[[str, str], list[str]],
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
) -> None:
    page = "docs/how-to/choose-a-receiver.md"
    shows(page, shell(code_blocks(page, "sh")[0], root), part=True)


def test_its_lines_and_its_table_run(root: Path, guide: str, tmp_path: Path) -> None:
    ((lines, _), (table,)) = (
        re.findall(rf"^```{kind}\n(.*?)^```", guide, re.MULTILINE | re.DOTALL) for kind in ("ini", "csv")
    )
    (tmp_path / "rates.csv").write_text(table)
    file = tmp_path / "all.ini"
    file.write_text(f"[General]\n{lines}\ninclude {root}/configs/reference/jittered.ini\n")
    (scenario,) = load_scenarios(file, overrides=["sim-time-limit = 2.1s"])
    assert not lint_networks([scenario])
    fates = gradysim.integrated.run.run(scenario).fates["frames"]["broadcast"]
    assert fates["delivered"] > 0
    assert fates["preamble_undetected"] > 0


def test_other_systems_make_the_step_of_delivery_as_wide_as_it_says(
    guide: str, code_blocks: Callable[[str, str], list[str]], tmp_path: Path
) -> None:
    lines = code_blocks("docs/how-to/choose-a-receiver.md", "ini")[1]
    file = tmp_path / "others.ini"
    file.write_text(
        "[General]\nsim-time-limit = 1s\n*.numN = 2\n"
        f'*.n[*].protocol.typename = "SinkProtocol"\n**.wlan[*].bitrate = 6Mbps\n{lines}'
    )

    def width_db(*overrides: str) -> float:
        (scenario,) = load_scenarios(file, overrides=overrides)
        assert not lint_networks([scenario])
        low, high = (calibrate(scenario, 100, ratio=ratio).tx_power_w for ratio in (0.1, 0.9))
        return 10 * math.log10(high / low)

    without = width_db("*.radioMedium.otherSystems.power = 0W")
    figures = re.search(r"takes (\d+) dB of received power, and (\d+) dB without", guide)
    assert figures is not None
    assert (round(width_db()), round(without)) == tuple(map(int, figures.groups()))
