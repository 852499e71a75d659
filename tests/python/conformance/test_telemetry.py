"""A protocol may change its telemetry: the next one is a new object."""

from typing import Any

import pytest
from perfect_channel import MODES, Case

from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.position import Position
from python.quiet_protocol import Quiet


class Flying(Quiet):
    """Flies along x, and records its positions."""

    def initialize(self) -> None:
        self.places: list[Position] = []
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(100.0, 0.0, 0.0))

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        x, y, z = telemetry.current_position
        self.places.append((x, y, z))

    def finish(self) -> None:
        self.provider.tracked_variables["places"] = self.places


class Blurring(Flying):
    """Overwrites the received position, like a sensor with an error."""

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        self.places.append(telemetry.current_position)
        telemetry.current_position = (0.0, 0.0, 0.0)


class Marking(Flying):
    """Marks every telemetry, and looks for earlier marks."""

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        super().handle_telemetry(telemetry)
        assert not hasattr(telemetry, "seen")
        telemetry.seen = True  # type: ignore[attr-defined]


class Keeping(Flying):
    """Keeps all telemetry to read it at the end."""

    def initialize(self) -> None:
        super().initialize()
        self.kept: list[Telemetry] = []

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        self.kept.append(telemetry)

    def finish(self) -> None:
        for telemetry in self.kept:
            super().handle_telemetry(telemetry)
        super().finish()


class KeepingFields(Flying):
    """Keeps the content of all telemetry."""

    def initialize(self) -> None:
        super().initialize()
        self.kept: list[dict[str, Position]] = []

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        self.kept.append(vars(telemetry))

    def finish(self) -> None:
        self.places = [fields["current_position"] for fields in self.kept]
        super().finish()


class Replacing(Flying):
    """Replaces the fields of each telemetry by those of another one."""

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        super().handle_telemetry(telemetry)
        telemetry.__dict__ = {"current_position": (0.0, 0.0, 0.0)}


class Looking(Flying):
    """Looks up positions by their hash."""

    def initialize(self) -> None:
        super().initialize()
        self.seen: set[Position] = set()

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        super().handle_telemetry(telemetry)
        assert telemetry.current_position not in self.seen
        self.seen.add(self.places[-1])


def places(mode: str, protocol: type[Flying]) -> Any:
    case = Case([(0.0, 0.0, 0.0)], telemetry_interval_s=0.125, speed_mps=8.0, duration_s=1.0)
    return case.run(mode, protocol).nodes[0].tracked_variables["places"]


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("protocol", [Blurring, Marking, Keeping, KeepingFields, Replacing, Looking])
def test_each_telemetry_is_its_own(mode: str, protocol: type[Flying]) -> None:
    flown = places(mode, Flying)
    assert len(set(flown)) >= 7
    assert places(mode, protocol) == flown
