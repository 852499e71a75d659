"""The scenario and the engine agree with docs/how-to/use-ieee802154.md."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.integrated.run import run
from gradysim.scenario import load_scenarios


@pytest.fixture
def guide(root: Path) -> str:
    return (root / "docs/how-to/use-ieee802154.md").read_text(encoding="utf-8")


def test_its_command_prints_what_it_shows(
    root: Path,
    code_blocks: Callable[[str, str], list[str]],
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
) -> None:
    page = "docs/how-to/use-ieee802154.md"
    (command,) = code_blocks(page, "sh")
    shows(page, shell(command, root), part=True)


def test_its_ini_lines_are_those_of_the_scenario(guide: str, root: Path) -> None:
    (block,) = re.findall(r"^```ini\n(.*?)^```", guide, re.MULTILINE | re.DOTALL)
    scenario = (root / "configs/sensor_field.ini").read_text(encoding="utf-8").splitlines()
    assert [line for line in block.splitlines() if line not in scenario] == []


def test_nine_of_ten_messages_go_as_far_as_it_says(guide: str, root: Path) -> None:
    ((payload_bytes, distance_m),) = re.findall(r"nine of ten messages of (\d+) B arrive over (\d+) m", guide)
    (scenario,) = load_scenarios(
        root / "configs/reference/narrowband.ini",
        "Goodput",
        overrides=[
            f"*.senders[*].protocol.payload_bytes = {payload_bytes}",
            f"*.sink.mobility.initialX = {distance_m}m",
            "**.wlan[*].radio.receiver.snirThreshold = -8dB",
            "**.wlan[*].mac.useMACAcks = false",
        ],
    )
    frames = run(scenario).outcomes["frames"]["unicast"]
    assert frames["delivered"] / (frames["delivered"] + frames["noise"]) == pytest.approx(0.9, abs=0.02)


@pytest.mark.parametrize("medium", ["", "airtime"])
def test_frames_on_a_unit_disk_take_time_with_airtime(guide: str, root: Path, medium: str) -> None:
    assert '`*.radioMedium.timing = "airtime"`' in " ".join(guide.split())
    lines = ['*.radioMedium.typename = "UnitDiskRadioMedium"']
    lines += [f'*.radioMedium.timing = "{medium}"'] if medium else []
    overrides = [*lines, "sim-time-limit = 5s"]
    (scenario,) = load_scenarios(root / "configs/sensor_field.ini", overrides=overrides)
    delays = run(scenario).message_delays["unicast"]
    assert (delays.mean_s > 1e-3) == bool(medium)
