"""A case in the engine: sent and received frames, from capture files and results."""

from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand, SetSpeedMobilityCommand
from verification.oracle.captured_frame import CapturedFrame, read_capture
from verification.oracle.case import BREAKPOINT, Air, Case, Course, Send, Station

if TYPE_CHECKING:
    from gradysim._netsim import MediumConfig, Network, Node, NodeConfig

END_S = 1000.0
"""Long after the last retry: there is nothing in the air."""


@dataclass(frozen=True)
class EngineRun:
    """Results by station."""

    sent: list[list[CapturedFrame]]
    received: list[list[CapturedFrame]]
    outcomes: list[Counter[tuple[str, str]]]
    """Receptions above the sensitivity, by (kind, outcome)."""
    below_sensitivity: int
    """Receptions of all kinds at all stations."""
    instants_ps: list[int]
    """Times of all events, ascending. Captures are truncated to nanoseconds; these give the exact times."""


def run_engine(case: Case, folder: Path) -> EngineRun:
    """Run it to its end; write the captures to the directory."""
    from gradysim._netsim import Network

    network = Network(_medium_config(case.air), case.seed)
    files = [folder / f"{index}.pcap" for index in range(len(case.stations))]
    for index, station in enumerate(case.stations):
        node = network.add_node(_node_config(case, index, station))
        node.set_protocol(_Scripted(node, station), _raise)
        network.capture(index, str(files[index]))
    try:
        network.initialize()
        instants_ps = _instants(network)
        network.finish()
        frames = [read_capture(file) for file in files]
        return EngineRun(
            sent=[[frame for frame in all_ if frame.signal_dbm is None] for all_ in frames],
            received=[[frame for frame in all_ if frame.signal_dbm is not None] for all_ in frames],
            outcomes=[_counted(network.frame_outcomes_at(index)) for index in range(len(files))],
            below_sensitivity=sum(
                outcomes["below_sensitivity"] for outcomes in network.frame_outcomes().values()
            ),
            instants_ps=instants_ps,
        )
    finally:
        network.release_protocols()


class _Scripted:
    """Protocol that sends and flies at given times."""

    def __init__(self, node: "Node", station: Station) -> None:
        self._node = node
        self._actions: list[Send | Course] = [*station.courses, *station.sends]

    def initialize(self) -> None:
        for index, action in enumerate(self._actions):
            self._node.schedule_timer(str(index), action.time_ns / 1e9)

    def handle_timer(self, timer: str) -> None:
        action = self._actions[int(timer)]
        if isinstance(action, Course):
            self._node.send_mobility_command(SetSpeedMobilityCommand(action.speed_mps))
            self._node.send_mobility_command(GotoCoordsMobilityCommand(*action.target))
            return
        text = f"{timer} of {self._node.id}".ljust(action.payload_bytes, ".")
        self._node.send_communication_command(
            BroadcastMessageCommand(text)
            if action.destination is None
            else SendMessageCommand(text, action.destination)
        )

    def handle_packet(self, message: str) -> None: ...
    def handle_telemetry(self, telemetry: Any) -> None: ...
    def finish(self) -> None: ...


def _raise(error: BaseException, callback: str) -> None:
    raise error


def _instants(network: "Network") -> list[int]:
    instants_s: dict[float, None] = {}
    while network.step(END_S):
        instants_s[network.now] = None
    return [round(instant_s * 1e12) for instant_s in instants_s]


def _counted(outcomes: dict[str, dict[str, int]]) -> Counter[tuple[str, str]]:
    return Counter(
        {
            (kind, outcome): count
            for kind, counts in outcomes.items()
            for outcome, count in counts.items()
            if count
        }
    )


def _medium_config(air: Air) -> "MediumConfig":
    from gradysim._netsim import MediumConfig

    config = MediumConfig(air.medium)
    # Each medium has its own path loss and defaults, which are not set here.
    if air.free_space_alpha is not None:
        config.alpha = air.free_space_alpha
    elif air.breakpoint != BREAKPOINT:
        names = ("breakpoint_distance_m", "l01_db", "l02_db", "alpha1", "alpha2")
        for name, value in zip(names, air.breakpoint, strict=True):
            setattr(config, name, value)
    config.background_noise_w = air.noise_w
    if air.temperature_k is not None:
        config.background_noise = "ThermalNoise"
        config.temperature_k = air.temperature_k
    return config


def _node_config(case: Case, index: int, station: Station) -> "NodeConfig":
    from gradysim._netsim import NodeConfig

    config = NodeConfig(f"stations[{index}]")
    config.initial_position = station.position
    config.mobility.telemetry_interval_s = 0.0
    mac, radio, receiver = config.wlan[0].mac, config.wlan[0].radio, station.receiver
    mac.op_mode = station.op_mode
    mac.bitrate_bps = station.bitrate_mbps * 1e6
    mac.rts_threshold_bytes = case.rts_threshold_bytes
    radio.carrier_hz = station.carrier_hz
    radio.bandwidth_hz = station.bandwidth_hz
    radio.tx_power_w = station.tx_power_w
    radio.sensitivity_w = receiver.sensitivity_w
    radio.energy_detection_w = receiver.energy_detection_w
    radio.snir_threshold = receiver.snir_threshold
    radio.error_model = "Ieee80211NistErrorModel"
    radio.noise_figure = receiver.noise_figure
    radio.snir_mode = "chunks" if receiver.by_chunks else "min"
    if receiver.preamble_detection is not None:
        radio.preamble_detection = "ThresholdPreambleDetection"
        radio.preamble_threshold = receiver.preamble_detection.threshold
        radio.preamble_minimum_power_w = receiver.preamble_detection.minimum_power_w
        radio.preamble_duration_s = receiver.preamble_detection.duration_us * 1e-6
    if receiver.frame_capture is not None:
        radio.frame_capture = "SimpleFrameCapture"
        radio.capture_margin = receiver.frame_capture.margin
        radio.capture_window_s = receiver.frame_capture.window_us * 1e-6
    return config
