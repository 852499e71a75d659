"""Records runs of the engine for a replay."""

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.network import medium_config, node_config
from gradysim.integrated.power_for_range import MESSAGE_BYTES, RATIO, PowersForRanges
from gradysim.protocol.plain_value import as_float, key_text
from gradysim.replay.chunk import RawChunk
from gradysim.replay.tables import text_of_value
from gradysim.scenario.keys import has_radios
from gradysim.scenario.scenario import Scenario

if TYPE_CHECKING:
    from gradysim._netsim import MediumConfig, Network, NodeConfig

_FARTHEST_M = 1e6
_STEPS = 40
"""Bisections of a distance: more digits than a circle on a page shows."""


_LARGE = 1 << 53
"""Integers below are floats, too."""

VariableListener: TypeAlias = Callable[[str, Any], None]
"""Takes the name and the new value of a tracked variable; the value is None if it was removed."""


class EngineRecorder:
    """The engine's recorder, for values of Python."""

    def __init__(self, network: "Network", scenario: Scenario, recorded: frozenset[int]) -> None:
        """Start to record; `recorded` are ids of nodes that are recorded in full."""
        self._recorded = recorded
        self._recorder = network.record(sorted(self._recorded))
        for node in scenario.nodes:
            if node.autopilot is not None or node.is_quadcopter:
                self._recorder.sample_path(node.id)

    def variable_listener(self, node_id: int) -> VariableListener | None:
        """Return what records the tracked variables of a node; None if they are not recorded."""
        if node_id not in self._recorded:
            return None
        set_variable = self._recorder.variable_set

        def tell(name: str, value: Any) -> None:
            kind = type(value)
            if (
                type(name) is str
                and name.isascii()
                and (kind is float or (kind is int and abs(value) < _LARGE))
            ):
                set_variable(node_id, name, value)  # nearly always
                return
            number = None if isinstance(value, bool) else as_float(value)
            told = text_of_value(value) if number is None else number
            set_variable(node_id, _utf8(key_text(name)), told if number is not None else _utf8(str(told)))

        return tell

    def event(self, node_id: int, kind: int, text: str) -> None:
        """Record an event of a kind of `EVENT_KINDS`, by number."""
        self._recorder.event(node_id, kind, _utf8(text))

    def chunks(self, *, cut: bool, last: bool) -> Iterator[RawChunk]:
        """Return the complete chunks; `cut` ends the current one, `last` the record."""
        if last:
            self._recorder.finish()
        elif cut:
            self._recorder.close_chunk()
        for chunk in self._recorder.take():
            yield RawChunk(**chunk)


def _utf8(text: str) -> str:
    """Return a string without characters that UTF-8 cannot encode."""
    return text.encode(errors="replace").decode()


def ranges_m(scenario: Scenario) -> list[float | None]:
    """Return the distance (m) at which half of the messages of each node arrive, without other senders.

    Between nodes like this one, over wlan[0]. None if the engine cannot compute it.
    """
    medium = medium_config(scenario)
    powers = PowersForRanges(medium)
    known: dict[object, float | None] = {}
    ranges: list[float | None] = []
    for spec in scenario.nodes:
        key = (id(spec.wlan[0]), spec.initial_position[2])
        if key not in known:
            config = node_config(spec)
            if has_radios(medium.typename):
                powers.set_powers(config, spec)
                known[key] = _range_m(medium, config)
            else:
                known[key] = config.wlan[0].radio.communication_range_m
        ranges.append(known[key])
    return ranges


def _range_m(medium: "MediumConfig", config: "NodeConfig") -> float | None:
    netsim = load_netsim()
    try:
        budget = netsim.LinkBudget(medium, config, config, MESSAGE_BYTES, 0)
    except netsim.ConfigError:  # the message does not fit into a frame
        return None
    power_w = config.wlan[0].radio.tx_power_w
    near_m, far_m = 0.0, _FARTHEST_M
    for _ in range(_STEPS):
        middle_m = (near_m + far_m) / 2
        if budget.reception_ratio(middle_m, power_w) >= RATIO:
            near_m = middle_m
        else:
            far_m = middle_m
    return near_m
