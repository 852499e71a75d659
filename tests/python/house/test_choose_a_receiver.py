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
from gradysim.scenario.parse.ini import PROFILES


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
    outcomes = gradysim.integrated.run.run(scenario).outcomes["frames"]["broadcast"]
    assert outcomes["delivered"] > 0
    assert outcomes["preamble_undetected"] > 0


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


MESSAGE_BYTES = 936
"""In a frame of 1000 B."""
NO_LIMIT = "**.receiver.snirThreshold = -200dB"
CURVES = {
    "here, without `snirThreshold`": (NO_LIMIT,),
    "here": (),
    "ns-3's curves": (
        NO_LIMIT,
        '**.errorModel.typename = "Ieee80211BerTableErrorModel"',
        f'**.errorModel.berTableFile = "{PROFILES}/ns3_error_rates.csv"',
    ),
    "INET's curves": (NO_LIMIT, '**.errorModel.typename = "Ieee80211NistErrorModel"'),
    "INET's curves and its `snirThreshold`": (
        "**.receiver.snirThreshold = 4dB",
        '**.errorModel.typename = "Ieee80211NistErrorModel"',
    ),
}


@pytest.mark.parametrize("curves", CURVES)
def test_half_of_the_frames_arrive_at_the_ratios_of_its_table(
    guide: str, tmp_path: Path, curves: str
) -> None:
    (tmp_path / "pair.ini").write_text(
        '[General]\nsim-time-limit = 1s\n*.numN = 2\n*.n[*].protocol.typename = "SinkProtocol"\n'
        "**.wlan[*].radio.receiver.sensitivity = -140dBm\n"
    )

    def half_db(mode: str, mbps: float) -> float:
        lines = (f'**.wlan[*].opMode = "{mode}"', f"**.wlan[*].bitrate = {mbps}Mbps", *CURVES[curves])
        (scenario,) = load_scenarios(tmp_path / "pair.ini", overrides=lines)
        found = calibrate(scenario, 10, ratio=0.5, message_bytes=MESSAGE_BYTES)
        return 10 * math.log10(found.snr_at_range)

    halves = [half_db("b", mbps) for mbps in (1, 2, 5.5, 11)] + [half_db("g(erp)", 6)]
    (row,) = re.findall(rf"^\| {re.escape(curves)} \| (.*) \|$", guide, re.MULTILINE)
    assert row == " | ".join(f"{half:.1f} dB" for half in halves)
