"""docs/how-to/model-my-radio.md: its lines run, and its ranges and levels are the engine's."""

import math
import re
import statistics
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.integrated.calibration import calibrate
from gradysim.integrated.network import node_config
from gradysim.integrated.network_lint import lint_networks
from gradysim.integrated.ranges import ranges_m
from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.parse.ini import PROFILES
from verification.test_field import NOISE_DBM

PAGE = "docs/how-to/model-my-radio.md"
NODES = '\nsim-time-limit = 1s\n*.numN = 2\n*.n[*].protocol.typename = "SinkProtocol"\n'


@pytest.fixture
def page(root: Path) -> str:
    return (root / PAGE).read_text(encoding="utf-8")


@pytest.fixture
def loaded(tmp_path: Path) -> Callable[[str, str], Scenario]:
    """`loaded(lines, bitrate)`: two nodes with lines of the page."""

    def load(lines: str, bitrate_mbps: str) -> Scenario:
        (tmp_path / "page.ini").write_text(f"[General]{NODES}{lines}")
        bitrate = f"**.wlan[*].bitrate = {bitrate_mbps}Mbps"
        (scenario,) = load_scenarios(tmp_path / "page.ini", overrides=[bitrate])
        return scenario

    return load


def test_its_ranges(
    page: str, code_blocks: Callable[[str, str], list[str]], loaded: Callable[[str, str], Scenario]
) -> None:
    lines = code_blocks(PAGE, "ini")[0].replace("[General]\n", "")
    rows = re.findall(r"^\| (\d+) Mbps \| (\d+) m \| (\d+) m \|", page, re.MULTILINE)
    assert len(rows) == 4
    for bitrate, by_default, measured in rows:
        assert round(ranges_m(loaded(lines, bitrate))[0] or 0) == int(measured)
        without = lines.replace("include", "# include")
        assert round(ranges_m(loaded(without, bitrate))[0] or 0) == int(by_default)


def test_its_levels_above_the_noise(
    page: str, code_blocks: Callable[[str, str], list[str]], loaded: Callable[[str, str], Scenario]
) -> None:
    bitrates, levels = (
        re.findall(r"[\d.]+", line) for line in page.splitlines() if re.match(r"\| (bitrate, M|dB)", line)
    )
    for bitrate, level in zip(bitrates, levels, strict=True):
        scenario = loaded(code_blocks(PAGE, "ini")[1], bitrate)
        snr = calibrate(scenario, 10, ratio=0.9, message_bytes=1000).snr_at_range
        assert 10 * math.log10(snr) == pytest.approx(float(level), abs=0.06)


def test_its_noise_figure(page: str) -> None:
    assert round(NOISE_DBM) == -101
    assert "-85 + 101 - 13.4 = 2.6 dB" in page


def test_each_measured_profile_is_told_and_read(page: str, root: Path, tmp_path: Path) -> None:
    for profile in sorted(PROFILES.glob("as_measured_*.ini")):
        assert f"| `{profile.name}` |" in page
        (tmp_path / "with.ini").write_text(f"[General]{NODES}include {profile.name}\n")
        (scenario,) = load_scenarios(tmp_path / "with.ini")
        assert lint_networks([scenario]) == []


def test_each_node_draws_its_noise_figure(
    code_blocks: Callable[[str, str], list[str]], tmp_path: Path
) -> None:
    thermal, drawn = code_blocks(PAGE, "ini")[1:3]
    (tmp_path / "drawn.ini").write_text(f"[General]{NODES}{drawn}{thermal}")

    def figures_db(seed: int) -> list[float]:
        overrides = f"seed-set = {seed}", "*.numN = 400"
        (scenario,) = load_scenarios(tmp_path / "drawn.ini", overrides=overrides)
        return [10 * math.log10(node_config(spec).wlan[0].radio.noise_figure) for spec in scenario.nodes]

    figures = figures_db(1)
    assert len(set(figures)) == len(figures)
    assert statistics.mean(figures) == pytest.approx(4, abs=0.08)
    assert statistics.stdev(figures) == pytest.approx(0.4, rel=0.15)
    assert figures_db(1) == figures
    assert figures_db(2) != figures
