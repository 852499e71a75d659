"""Fixtures of several directories: small scenarios, a wall clock, a vehicle with MAVLink."""

import json
import shutil
import signal
import stat
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

from gradysim.scenario import Scenario, load_scenarios
from gradysim.simulator import real_time
from python.quiet_protocol import QUIET

PROTOCOL = f"""{QUIET}
import random
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand, GotoGeoCoordsMobilityCommand

class Talker(Quiet):
    heard = 0
    def initialize(self):
        self.provider.schedule_timer("talk", 0.1 + 0.01 * self.provider.get_id())
    def handle_timer(self, timer):
        self.provider.send_communication_command(BroadcastMessageCommand(f"{{random.random()}}"))
        self.provider.schedule_timer("talk", self.provider.current_time() + 0.1)
    def handle_packet(self, message):
        self.heard += 1
        self.provider.tracked_variables["heard"] = self.heard
    def finish(self):
        self.provider.tracked_variables["finished"] = True
"""

INI = """[General]
sim-time-limit = 2.05s
*.uavs.count = 2
*.uavs[*].protocol.class = "protocol.py:Tested"
*.uavs[*].mobility.lineStepX = 10m
*.uavs[*].mobility.telemetryInterval = 0.5s
"""

FLOWN = (
    '*.uavs[0].mobility.typename = "ArdupilotMobility"',
    '*.uavs[0].mobility.autopilotUser = ""',
    "*.uavs[0].mobility.initialZ = 10m",
    "sim-time-limit = 12s",
)

settings.register_profile("any machine", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("any machine")  # a busy machine must not make a test fail


@pytest.fixture(autouse=True, scope="session")
def stopping_signals() -> None:
    """Make Ctrl-C and SIGHUP stop commands also in the background and under nohup, where they are ignored."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


@pytest.fixture
def make_scenario(tmp_path: Path) -> Callable[..., Scenario]:
    """`make_scenario(python, *settings)`: two nodes that run the class Tested of `python`."""

    def make(python: str = "class Tested(Talker): pass", *settings: str) -> Scenario:
        (tmp_path / "protocol.py").write_text(f"{PROTOCOL}\n{python}\n", encoding="utf-8")
        (tmp_path / "test.ini").write_text(INI, encoding="utf-8")
        (scenario,) = load_scenarios(tmp_path / "test.ini", overrides=settings)
        return scenario

    return make


@pytest.fixture
def toy_copter(tmp_path: Path) -> Callable[..., Path]:
    """`toy_copter({0: {"deaf": True}})`: path of a program that replaces ArduCopter, with these faults."""
    folder = tmp_path / "program"
    folder.mkdir()
    program = folder / "arducopter"
    sources = Path(__file__).parent / "sitl"
    text = (sources / "toy_copter.py").read_text()
    program.write_text(text.replace("#!/usr/bin/env python3", f"#!{sys.executable}", 1))
    for part in ("toy_vehicle.py", "toy_lock_step.py"):
        shutil.copy(sources / part, folder)
    program.chmod(program.stat().st_mode | stat.S_IXUSR)

    def with_wrongs(wrongs: dict[int, Any] | None = None) -> Path:
        (folder / "misbehavior.json").write_text(json.dumps(wrongs or {}))
        return program

    return with_wrongs


@pytest.fixture
def flown_scenario(
    make_scenario: Callable[..., Scenario], toy_copter: Callable[..., Path], monkeypatch: pytest.MonkeyPatch
) -> Callable[..., Scenario]:
    """`flown_scenario(python, *settings, wrongs=...)`: as `make_scenario`, with node 0 flown by the toy."""

    def make(python: str, *settings: str, wrongs: dict[int, Any] | None = None) -> Scenario:
        monkeypatch.setenv("GRADYSIM_ARDUPILOT", str(toy_copter(wrongs)))
        return make_scenario(python, *settings, *FLOWN)

    return make


@pytest.fixture(scope="session")
def type_errors(pytestconfig: pytest.Config) -> Callable[[Path], str]:
    """`type_errors(file)`: errors of mypy --strict in a file, run in its directory.

    Empty if there are none.
    """
    package = Path(__file__).parents[2] / "python"
    assert pytestconfig.cache is not None
    cache = f"--cache-dir={pytestconfig.cache.mkdir('mypy')}"

    def errors(file: Path) -> str:
        check = subprocess.run(
            [sys.executable, "-m", "mypy", "--strict", "--config-file=", cache, file.name],
            cwd=file.parent,
            env={"MYPYPATH": str(package), "PATH": ""},
            capture_output=True,
            text=True,
            check=False,
        )
        return "" if check.returncode == 0 else check.stdout + check.stderr

    return errors


class WallClock:
    """Replacement of the module `time`: it advances only by `sleep`."""

    def __init__(self) -> None:
        self.now = 100.0
        self.sleeps: list[float] = []

    def monotonic(self) -> float:
        """Return seconds."""
        return self.now

    def sleep(self, duration_s: float) -> None:
        """Advance the clock."""
        self.sleeps.append(duration_s)
        self.now += duration_s


@pytest.fixture
def wall_clock(monkeypatch: pytest.MonkeyPatch) -> WallClock:
    """Return the clock of simulations in real time."""
    clock = WallClock()
    monkeypatch.setattr(real_time, "time", clock)
    return clock
