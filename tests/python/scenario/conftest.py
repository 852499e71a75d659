"""Configuration and protocol files for the tests of this directory."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.parse.patterns import Pattern

PROTOCOLS = """
from gradysim.protocol.interface import IProtocol


class Sensor(IProtocol):
    def initialize(self): pass
    def handle_timer(self, timer): pass
    def handle_packet(self, message): pass
    def handle_telemetry(self, telemetry): pass
    def finish(self): pass


class Mobile(Sensor):
    heartbeat_jitter: float = 0
    launch_interval = 5.0
    retries = 3
    label = "mobile"
    eager = False
    waypoints = [1, 2]
    _private = 1


class Half(IProtocol):
    def initialize(self): pass


class Other: pass
"""

BASE = """[General]
sim-time-limit = 1h
*.groundStation.protocol.class = "protocols.py:Sensor"
*.numUavs = 2
*.uavs[*].protocol.class = "protocols.py:Mobile"
"""
"""Five lines; lines added by a test start at line 6."""


class Folder:
    """A directory with an .ini file and its protocols."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.ini = path / "test.ini"
        self.write("protocols.py", PROTOCOLS)
        self.write("test.ini", BASE)

    def write(self, name: str, text: str) -> Path:
        file = self.path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return file

    def load(self, added: str = "", config: str = "General", *overrides: str) -> Scenario:
        """Load run 0 of the base with additional lines."""
        self.write("test.ini", BASE + added)
        return load_scenarios(self.ini, config, "0", overrides)[0]

    def mistake(self, added: str = "", config: str = "General", *overrides: str) -> ConfigError:
        """Return the error of the base with additional lines."""
        with pytest.raises(ConfigError) as caught:
            self.load(added, config, *overrides)
        return caught.value

    def error(self, added: str = "", config: str = "General", *overrides: str) -> str:
        """Return the message of the error, without the directory."""
        with pytest.raises(ConfigError) as caught:
            self.load(added, config, *overrides)
        return str(caught.value).replace(f"{self.path}/", "")


@pytest.fixture
def folder(tmp_path: Path) -> Folder:
    return Folder(tmp_path)


@pytest.fixture
def write_ini(tmp_path: Path) -> Callable[..., Path]:
    def write(text: str, name: str = "test.ini") -> Path:
        file = tmp_path / name
        file.write_bytes(text.encode())
        return file

    return write


@pytest.fixture
def count_matches(monkeypatch: pytest.MonkeyPatch) -> Callable[[Callable[[], object]], int]:
    """`count_matches(do)`: number of comparisons with patterns during the call."""
    compared = 0
    matches = Pattern.matches

    def counted(pattern: Pattern, path: str) -> bool:
        nonlocal compared
        compared += 1
        return matches(pattern, path)

    def count(do: Callable[[], object]) -> int:
        nonlocal compared
        compared = 0
        do()
        return compared

    monkeypatch.setattr(Pattern, "matches", counted)
    return count
