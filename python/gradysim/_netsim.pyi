"""The compiled engine. Names, arguments and meaning are those of the C++ sources in cpp/netsim."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from gradysim._netsim_fields import (
    AntennaFields,
    ComputerFields,
    CsmaFields,
    InterfaceFields,
    MacFields,
    MediumFields,
    MessagePart,
    MobilityFields,
    ObstacleFields,
    RadioFields,
    WindFields,
)

class ConfigError(ValueError):
    """A value of a configuration is outside its range; the text names the field, the value and the range."""

    field: str
    """Full name of the field, "radio.tx_power_w"; "" for an error that is about no field."""
    value: MessagePart
    message: Sequence[MessagePart]
    """What is wrong, in parts: texts, quantities (value, unit) and full names of fields (name,)."""
    compared_with: Sequence[str]
    """Full names of the fields that decide whether the value is right, the likeliest cause first."""
    interface: int | None
    """Index of the network interface, if the node has several."""

class SimulationError(RuntimeError):
    """A command that cannot be carried out: a timer in the past, an unknown destination."""

def schema() -> list[dict[str, Any]]:
    """The declarations of all fields, as in scenario/schema/schema.json."""

longest_run_s: float
"""The largest time that a run can reach, in seconds."""

class ProtocolError(SimulationError):
    """A native protocol got something wrong in a run; one of Python raises what it raises."""

    node_id: int
    callback: str
    time_s: float

class MediumConfig(MediumFields):
    """The type chooses the defaults of the other fields, so it is given at the start and stays."""

    obstacles: list[ObstacleConfig]
    """Comes and goes as a copy: a change of the list, or in it, has to be assigned."""

    def __init__(self, typename: str = ...) -> None: ...
    def validate(self) -> None: ...

def antenna_gain(config: AntennaConfig, carrier_hz: float, direction: tuple[float, float, float]) -> float:
    """Linear gain towards `direction`, of any length but 0, seen from the antenna."""

class Propagation:
    """What is left of a transmission on its way: path loss and fading, as the engine calculates them."""

    def __init__(self, config: MediumConfig, seed: int) -> None:
        """Of a run with that seed. ConfigError: a value out of range, or a medium without a path loss."""
    def gain(
        self,
        from_position: tuple[float, float, float],
        to_position: tuple[float, float, float],
        carrier_hz: float,
        from_node: int = ...,
        to_node: int = ...,
        time: float = ...,
        transmission: int = ...,
    ) -> float:
        """Received over transmitted power, for a transmission that starts at `time` (seconds).

        `transmission`, its number, matters only to fading with a coherence time of 0.
        """
    def reach_m(self, gain: float, carrier_hz: float) -> float:
        """The distance beyond which no gain reaches `gain`, however lucky the fading."""
    def most_gain_beyond(self, distance_m: float, carrier_hz: float) -> float:
        """What no gain exceeds at that distance and beyond."""

class LinkBudget:
    """The chances of one broadcast frame over a distance, with nobody else on the air.

    Where the gain is random, the share is the mean over all states of the link. Antennas look at each other
    with their largest gain, and no obstacle is between them.
    """

    def __init__(
        self,
        medium: MediumConfig,
        sender: NodeConfig,
        receiver: NodeConfig,
        payload_bytes: int,
        interface: int = ...,
    ) -> None:
        """For messages of that length through wlan[interface]; heights are the z of the initial positions.

        ConfigError: a value out of range, a medium without path loss, different bands, a message too long.
        """
    def reception_ratio(self, distance_m: float, tx_power_w: float) -> float:
        """The share of frames sent with that power that are decoded at that distance, 0 to 1."""
    def tx_power_w_for(self, range_m: float, ratio: float) -> float:
        """The least power at which at least that share is decoded; ConfigError: no power would do.

        To 0.01 dB where the gain is random; elsewhere a few billionths more, lest rounding make it too
        little.
        """
    def mean_gain(self, distance_m: float) -> float:
        """Mean received power of 1 W."""
    @property
    def tx_power_w(self) -> float:
        """Of the sender's frames."""
    @property
    def bitrate_bps(self) -> float: ...
    @property
    def psdu_bytes(self) -> int: ...
    @property
    def noise_w(self) -> float: ...

class ObstacleConfig(ObstacleFields):
    name: str
    rings: Sequence[Sequence[tuple[float, float]]]
    def validate(self) -> None: ...

class AntennaConfig(AntennaFields):
    def validate(self, carrier_hz: float) -> None: ...

class RadioConfig(RadioFields):
    """The interface chooses the defaults."""

    antenna: AntennaConfig
    def __init__(self, interface: str = ...) -> None: ...
    def validate(self) -> None: ...

class MacConfig(MacFields):
    def validate(self) -> None: ...

class CsmaConfig(CsmaFields):
    @property
    def ack_end_s(self) -> float:
        """From the end of a frame to that of its ACK, next to its sender."""
    def validate(self) -> None: ...

class MobilityConfig(MobilityFields):
    def validate(self) -> None: ...

class WindConfig(WindFields):
    def validate(self) -> None: ...

class ComputerConfig(ComputerFields):
    def validate(self) -> None: ...

class InterfaceConfig(InterfaceFields):
    """Its type chooses the MAC and the defaults of the radio, so it stays what it was at the start."""

    radio: RadioConfig
    mac: MacConfig
    csma: CsmaConfig
    @property
    def known_formats(self) -> set[str]:
        """PPDU formats that it can decode: "HR/DSSS", "OFDM", "ERP-OFDM", "O-QPSK"."""
    def validate(self) -> None: ...

class NodeConfig:
    """With one network interface of each of the given types, by default one of 802.11."""

    name: str
    @property
    def wlan(self) -> tuple[InterfaceConfig, ...]: ...
    mobility: MobilityConfig
    wind: WindConfig
    computer: ComputerConfig
    initial_position: tuple[float, float, float]
    def __init__(self, name: str, interfaces: Sequence[str] = ...) -> None: ...
    def validate(self) -> None: ...

class RandomStream:
    """A stream of random numbers, by its name; gradysim.encapsulator.random_stream has the purposes."""

    def __init__(self, seed: int, node: int, purpose: int) -> None: ...
    def next_u32(self) -> int: ...
    def uniform(self) -> float:
        """Uniform in [0, 1), 53 random bits."""

class Parameter:
    """A parameter of a native protocol; its kind is that of its default."""

    @property
    def name(self) -> str: ...
    @property
    def default(self) -> bool | int | float: ...
    @property
    def unit(self) -> str: ...
    @property
    def meaning(self) -> str: ...

class NativeProtocol:
    """A protocol that the engine has itself."""

    @property
    def name(self) -> str: ...
    @property
    def meaning(self) -> str: ...
    @property
    def python_class(self) -> str:
        """The class in examples/ that does the same, as "file.py:Class", or ""."""
    @property
    def parameters(self) -> list[Parameter]: ...

def native_protocols() -> list[NativeProtocol]: ...

class Node:
    """The engine's side of one node: what its protocol may ask of it. Errors: gradysim.protocol.errors."""

    @property
    def id(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def position(self) -> tuple[float, float, float]: ...
    def set_protocol(
        self,
        protocol: Any,
        on_failure: Callable[[BaseException, str], None],
        wants_failed_messages: bool = ...,
    ) -> None:
        """Give the node a protocol: any object with the five methods of IProtocol.

        `on_failure(exception, callback_name)` is called when one of them raises, before the exception
        leaves `Network.run_until`. `handle_failed_message` is called if the protocol wants that.
        """
    def set_native_protocol(self, name: str, parameters: Mapping[str, bool | int | float] = ...) -> None:
        """Give the node a protocol of `native_protocols()`.

        ConfigError: there is none of that name, it has no such parameter, or a value is out of range.
        """
    def check_protocol(self) -> None:
        """Raise ConfigError for parameters that this node cannot have among those that are there now."""
    @property
    def tracked_variables(self) -> dict[str, bool | int | float | str]:
        """What a native protocol tracks; those of a protocol in Python are its provider's."""
    def observe(
        self,
        on_telemetry: Callable[[int, float, float, float], object] | None,
        on_variable: Callable[[str, bool | int | float | str], object],
    ) -> None:
        """Have somebody told what the node does, from now on.

        `on_telemetry(time_ps, x, y, z)`, in picoseconds and metres, is called before the protocol gets that
        telemetry, `on_variable(name, value)` when a native protocol sets a tracked variable.
        """
    def send_communication_command(self, command: Any) -> None: ...
    def send_mobility_command(self, command: Any) -> None: ...
    def schedule_timer(self, timer: str, timestamp: float) -> None: ...
    def cancel_timer(self, timer: str) -> None: ...
    def current_time(self) -> float: ...
    def current_time_ps(self) -> int:
        """Return the simulated time, whole: float seconds do not tell all picoseconds apart."""
    def get_id(self) -> int: ...

class ReplayRecorder:
    """Records what happens in a network; see `gradysim.replay.tables`."""

    def sample_path(self, node: int) -> None:
        """Record where the node is every 0.2 s, not each of its legs."""
    def variable_set(self, node: int, name: str, value: bool | int | float | str) -> None: ...
    def event(self, node: int, kind: int, text: str) -> None:
        """Record an event of a kind of `EVENT_KINDS`, by number."""
    def close_chunk(self) -> None: ...
    def finish(self) -> None:
        """Close the last chunk, with the frames that are on the air."""
    def take(self) -> list[dict[str, Any]]:
        """Give the chunks that are closed, as fields of `RawChunk`."""

class Network:
    def __init__(self, medium: MediumConfig, seed: int) -> None: ...
    def add_node(self, config: NodeConfig) -> Node: ...
    def capture(self, node: int, path: str | bytes, interface: int = ...) -> None:
        """Write what the radio of that interface sends and receives from now on to a pcap file.

        Raises ConfigError for a path that cannot be written, for an interface that is not there and for a
        medium without radios.
        """
    def close_captures(self) -> None:
        """Complete the capture files; `finish` does it, too. SimulationError if one could not be written."""
    def record(self, recorded: list[int]) -> ReplayRecorder:
        """Record the run from now on: the paths of all nodes, all that happens at the `recorded` ones."""
    def initialize(self) -> None: ...
    def run_until(self, time: float, max_events: int = ...) -> bool:
        """Run the events up to and including `time` (seconds). False when `max_events` came first."""
    def step(self, time: float) -> bool:
        """Run one event, if there is one up to and including `time` (seconds); otherwise return False."""
    def schedule(self, time: float, callback: Callable[[], object]) -> None:
        """Have `callback()` called as an event at `time`, in seconds of simulated time.

        It comes after what is scheduled for that time already. What it raises leaves `run_until`.
        SimulationError: the time is in the past, or no time.
        """
    def finish(self) -> None: ...
    def release_protocols(self) -> None:
        """Let go of the protocols and of scheduled callbacks, which refer back to the network.

        To be called in the end, in any case.
        """
    @property
    def now(self) -> float:
        """Simulated time in seconds."""
    @property
    def active_node(self) -> int:
        """Id of the node whose protocol is called now; -1 outside of calls."""
    @property
    def event_count(self) -> int: ...
    @property
    def pending_count(self) -> int:
        """Events that are scheduled now."""
    @property
    def fingerprint(self) -> str:
        """16 hexadecimal digits: a hash of what happened on the air and in the protocols."""
    def frame_outcomes(self) -> dict[str, dict[str, int]]:
        """Copies of frames, {kind: {outcome: count}}.

        Kinds: "broadcast", "unicast", "unicast overheard", "ack", "ack overheard", "rts",
        "rts overheard", "cts", "cts overheard".
        """
    def frame_outcomes_at(self, receiver: int) -> dict[str, dict[str, int]]:
        """The same for the copies at one node that were strong enough to be received, for any destination.

        Kinds: "broadcast", "unicast", "ack", "rts", "cts". "below_sensitivity" and "in_air" are not kept for
        each node, and 0.
        """
    def interferers_at(self, receiver: int) -> dict[int, int]:
        """{node: copies that this receiver lost to interference by frames of that node, or of it and others}.

        Of those on the air when the interference was at its strongest, meant are the strongest, as many as
        outweigh all the others together.
        """
    def frames_by_bitrate(self, node: int) -> dict[int, int]:
        """{bits per second: unicast frames of that node, with retries}; empty without a rate control."""
    def message_outcomes(self) -> dict[str, dict[str, int]]:
        """Messages handed to the MAC: {"broadcast" | "unicast": {outcome: count}}."""
    def message_outcomes_from(self, sender: int) -> dict[str, dict[str, dict[str, int]]]:
        """The same for each interface of a node: {"wlan[0]": {"broadcast" | "unicast": {outcome: count}}}."""
    def message_delays(self) -> dict[str, dict[str, Any]]:
        """How long those that protocols got took: {"broadcast" | "unicast": fields of `Delays`}.

        Kinds of which no protocol got any are left out.
        """
