"""The commands of docs/how-to/repeat-the-paper.md run and give its results.

Of the figures of ten runs of each size, only those of the smallest size in integrated mode are computed here.
"""

import json
import re
from collections.abc import Callable
from pathlib import Path
from statistics import fmean
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.integrated.calibration import calibrate
from gradysim.integrated.run import run
from gradysim.results.confidence_interval import estimate
from gradysim.scenario import load_scenarios

GUIDE = "docs/how-to/repeat-the-paper.md"

Shell = Callable[[str, Path], str]


@pytest.fixture
def text(root: Path) -> str:
    return (root / GUIDE).read_text()


@pytest.fixture
def commands(code_blocks: Callable[[str, str], list[str]]) -> list[str]:
    """Return the commands of the page, in order."""
    return [
        command for block in code_blocks(GUIDE, "sh") for command in block.replace("\\\n", "").splitlines()
    ]


def readings(root: Path, config: str, *overrides: str) -> list[int]:
    """Return the readings at the ground station at the end of each run in integrated mode."""
    counts = []
    for scenario in load_scenarios(root / "configs/zigzag.ini", config, overrides=overrides):
        count: Any = run(scenario).nodes[-1].tracked_variables["data"]
        counts.append(count)
    return counts


@pytest.mark.verify
def test_every_command_of_gradysim_runs(
    commands: list[str], shell: Shell, root: Path, tmp_path: Path
) -> None:
    runs = [command for command in commands if command.startswith("gradysim run ")]
    assert len(runs) == 8
    short = "--quiet --set sim-time-limit=1s --set repeat=1"
    for command in runs:
        shell(command.replace(".ini ", f".ini {short} ").replace("results/", f"{tmp_path}/"), root)
    (means,) = [command for command in commands if command.startswith("gradysim means ")]
    assert "groundStation data" in shell(means.replace("results/", f"{tmp_path}/"), root)


@pytest.mark.verify
def test_the_figures_are_drawn_from_a_study(
    code_blocks: Callable[[str, str], list[str]], shell: Shell, root: Path, tmp_path: Path
) -> None:
    pytest.importorskip("matplotlib")
    blocks = [block for block in code_blocks(GUIDE, "sh") if "gradysim plot " in block]
    short = [("repeat=10", "repeat=2"), ("15, 30, 60, 120}min", "1, 2, 120}s"), ("results/", f"{tmp_path}/")]
    for block in blocks:
        for old, new in short:
            block = block.replace(old, new)
        shell(block, root)
    collected = (tmp_path / "collected.csv").read_text().splitlines()
    assert collected[0] == "config,mode,time (s),runs,mean,low,high"
    assert len(collected) == 1 + 6 * 241
    assert len((tmp_path / "cost.csv").read_text().splitlines()) == 1 + 6 * 3


def test_at_the_ground_station_all_heartbeats_meet_its_own(
    commands: list[str], shell: Shell, text: str, root: Path
) -> None:
    (command,) = [command for command in commands if "--outcomes-at" in command]
    nodes = json.loads(shell(f"{command} --json --quiet", root))["nodes"]
    copies, stay = re.findall(
        r"(\d+) copies of heartbeats were .* send ([\d,]+) readings", " ".join(text.split())
    )[0]
    assert nodes[-1]["frame_outcomes"] == {"broadcast": {"receiver_transmitting": int(copies)}}
    assert sum(node["tracked_variables"].get("collected", 0) for node in nodes) == int(stay.replace(",", ""))


@pytest.mark.verify
def test_the_mean_of_ten_runs_is_that_of_the_table(root: Path, text: str) -> None:
    found = estimate(readings(root, "ZigZag5", "repeat = 10"))
    told = f"{found.mean:,.0f} ± {found.half_width:.0f}"
    assert re.search(rf"^\| ZigZag5 \| integrated \| .* \| {told} \| .* s \|$", text, re.MULTILINE)
    assert f"| -96.616 dBm, that of the scenario | {told} |" in text


@pytest.mark.verify
def test_more_noise_leaves_what_the_table_says(root: Path, text: str) -> None:
    noise = "*.radioMedium.backgroundNoise.power = -93dBm"
    found = estimate(readings(root, "ZigZag5", noise, "repeat = 10"))
    assert f"| -93 dBm | {found.mean:,.0f} ± {found.half_width:.0f} |" in text


def test_half_of_the_frames_arrive_over_the_ranges_of_the_table(root: Path, text: str) -> None:
    rows = re.findall(r"^\| (-[\d.]+) dBm.*? \| ([\d.]+) m \|", text, re.MULTILINE)
    assert len(rows) == 5
    for noise_dbm, range_m in rows:
        noise = f"*.radioMedium.backgroundNoise.power = {noise_dbm}dBm"
        (scenario,) = load_scenarios(root / "configs/zigzag.ini", "ZigZag5", overrides=[noise])
        power_w = calibrate(scenario, range_m=float(range_m)).tx_power_w
        assert power_w == pytest.approx(0.95e-3, rel=0.01)  # 1 % of power is 0.3 % of range


@pytest.mark.verify
@pytest.mark.parametrize(("step", "told"), [("1m", "collects nothing"), ("0m", "9,295 readings arrive")])
def test_the_last_uav_is_out_of_reach_unless_it_flies_as_low_as_the_first(
    root: Path, text: str, step: str, told: str
) -> None:
    assert told in text
    noise = "*.radioMedium.backgroundNoise.power = -89dBm"
    counts = readings(root, "ZigZag25", noise, f"*.uavs[*].protocol.altitude_step = {step}")
    assert counts == [9295 if step == "0m" else 0]


@pytest.mark.verify
def test_without_timeout_the_offset_frees_uavs_too(root: Path, text: str) -> None:
    assert "5 % fewer on the real channel" in " ".join(text.split())
    (with_it,) = re.findall(r"that of the scenario \| ([\d,]+) ±", text)
    without = readings(root, "ZigZag5", "repeat = 10", "*.uavs[*].protocol.interaction_timeout = 0s")
    assert 1 - fmean(without) / int(with_it.replace(",", "")) == pytest.approx(0.05, abs=0.005)
