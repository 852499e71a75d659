"""The compiled engine. Names, arguments and meaning are those of the C++ sources in cpp/netsim."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

class ConfigError(ValueError):
    """A value of a configuration is outside its range; the text names the field, the value and the range."""

class SimulationError(RuntimeError):
    """A command that cannot be carried out: a timer in the past, an unknown destination."""

longest_run_s: float
"""The largest time that a run can reach, in seconds."""

class ProtocolError(SimulationError):
    """A native protocol got something wrong in a run; one of Python raises what it raises."""

    node_id: int
    callback: str
    time_s: float

class MediumConfig:
    """The type chooses the defaults of the other fields, so it is given at the start and stays."""

    @property
    def typename(self) -> str: ...
    path_loss: str
    alpha: float
    breakpoint_distance_m: float
    l01_db: float
    l02_db: float
    alpha1: float
    alpha2: float
    epsilon_r: float
    polarization: str
    sigma_db: float
    k_db: float
    shape_factor: float
    coherence_time_s: float
    background_noise: str
    temperature_k: float
    background_noise_w: float
    propagation: str
    obstacle_loss: str
    enable_dielectric_loss: bool
    enable_reflection_loss: bool
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
    def bitrate_bps(self) -> float: ...
    @property
    def psdu_bytes(self) -> int: ...
    @property
    def noise_w(self) -> float: ...

class ObstacleConfig:
    name: str
    rings: Sequence[Sequence[tuple[float, float]]]
    base_m: float
    top_m: float
    material: str
    relative_permittivity: float
    conductivity_spm: float
    def validate(self) -> None: ...

class AntennaConfig:
    typename: str
    gain: float
    max_gain: float
    min_gain: float
    beam_width_rad: float
    wire_axis: str
    length_m: float
    offset_heading_rad: float
    offset_elevation_rad: float
    offset_bank_rad: float
    def validate(self, carrier_hz: float) -> None: ...

class RadioConfig:
    """The interface chooses the defaults."""

    carrier_hz: float
    bandwidth_hz: float
    tx_power_w: float
    communication_range_m: float
    sensitivity_w: float
    energy_detection_w: float
    snir_threshold: float
    error_model: str
    antenna: AntennaConfig
    noise_figure: float
    snir_mode: str
    ber_table_file: str
    preamble_detection: str
    preamble_threshold: float
    preamble_minimum_power_w: float
    preamble_duration_s: float
    frame_capture: str
    capture_margin: float
    capture_window_s: float
    def __init__(self, interface: str = ...) -> None: ...
    def validate(self) -> None: ...

class MacConfig:
    op_mode: str
    bitrate_bps: float
    multicast_bitrate_bps: float
    control_bitrate_bps: float
    rts_threshold_bytes: int
    short_retry_limit: int
    long_retry_limit: int
    inet_station_retry_counters: bool
    cw_min: int
    cw_max: int
    queue_capacity: int
    mtu_bytes: int
    backoff_optimization: bool
    initial_channel_busy: bool
    skip_backoff_if_idle: bool
    own_frames_set_nav: bool
    inet_eifs: bool
    rate_control: str
    initial_rate_bps: float
    rate_interval_s: float
    increase_threshold: int
    decrease_threshold: int
    increase_threshold_factor: float
    max_increase_threshold: int
    rate_update_interval_s: float
    look_around_share: float
    ewma_weight: float
    def validate(self) -> None: ...

class CsmaConfig:
    use_acks: bool
    max_frame_retries: int
    ack_wait_s: float
    @property
    def ack_end_s(self) -> float:
        """From the end of a frame to that of its ACK, next to its sender."""
    sifs_s: float
    lifs_s: float
    backoff_method: str
    max_backoffs: int
    min_be: int
    max_be: int
    contention_window: int
    unit_backoff_s: float
    cca_s: float
    cca_whole_window: bool
    turnaround_s: float
    queue_capacity: int
    def validate(self) -> None: ...

class MobilityConfig:
    typename: str
    speed_mps: float
    telemetry_interval_s: float
    face_forward: bool
    initial_heading_rad: float
    initial_elevation_rad: float
    initial_bank_rad: float
    def validate(self) -> None: ...

class InterfaceConfig:
    """Its type chooses the MAC and the defaults of the radio, so it stays what it was at the start."""

    @property
    def typename(self) -> str: ...
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
    def set_protocol(self, protocol: Any, on_failure: Callable[[BaseException, str], None]) -> None:
        """Give the node a protocol: any object with the five methods of IProtocol.

        `on_failure(exception, callback_name)` is called when one of them raises, before the exception
        leaves `Network.run_until`.
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
        on_telemetry: Callable[[int, float, float, float], object],
        on_variable: Callable[[int, str, bool | int | float | str], object],
    ) -> None:
        """Have somebody told what the node does, from now on.

        `on_telemetry(time_ps, x, y, z)`, in picoseconds and metres, is called before the protocol gets that
        telemetry, `on_variable(time_ps, name, value)` when a native protocol sets a tracked variable.
        """
    def send_communication_command(self, command: Any) -> None: ...
    def send_mobility_command(self, command: Any) -> None: ...
    def schedule_timer(self, timer: str, timestamp: float) -> None: ...
    def cancel_timer(self, timer: str) -> None: ...
    def current_time(self) -> float: ...
    def current_time_ps(self) -> int:
        """Return the simulated time, whole: float seconds do not tell all picoseconds apart."""
    def get_id(self) -> int: ...

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
    def event_count(self) -> int: ...
    @property
    def pending_count(self) -> int:
        """Events that are scheduled now."""
    @property
    def fingerprint(self) -> str:
        """16 hexadecimal digits: a hash of what happened on the air and in the protocols."""
    def frame_fates(self) -> dict[str, dict[str, int]]:
        """Copies of frames, {kind: {fate: count}}.

        Kinds: "broadcast", "unicast", "unicast overheard", "ack", "ack overheard", "rts",
        "rts overheard", "cts", "cts overheard".
        """
    def frame_fates_at(self, receiver: int) -> dict[str, dict[str, int]]:
        """The same for the copies at one node that were strong enough to be received, whoever they were for.

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
    def message_fates(self) -> dict[str, dict[str, int]]:
        """Messages handed to the MAC: {"broadcast" | "unicast": {fate: count}}."""
    def message_fates_from(self, sender: int) -> dict[str, dict[str, dict[str, int]]]:
        """The same for each interface of one node: {"wlan[0]": {"broadcast" | "unicast": {fate: count}}}."""
    def message_delays(self) -> dict[str, dict[str, Any]]:
        """How long those that protocols got took: {"broadcast" | "unicast": fields of `Delays`}.

        Kinds of which no protocol got any are left out.
        """
