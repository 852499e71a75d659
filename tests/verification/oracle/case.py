"""One scenario for the oracle of reception: plain data, for the engine and the oracle.

Powers are in watts, ratios linear, times in integers of nanoseconds.
"""

from dataclasses import dataclass

Point = tuple[float, float, float]

IEEE80211 = "Ieee80211ScalarRadioMedium"
"""With free space."""
NARROWBAND = "Ieee802154NarrowbandScalarRadioMedium"
"""With the breakpoint model."""
BREAKPOINT = (8.0, 40.2, 58.5, 2.0, 3.3)
"""Its defaults: see `Air`."""


@dataclass(frozen=True)
class Send:
    """A message handed to the MAC."""

    time_ns: int
    payload_bytes: int
    destination: int | None
    """None for a broadcast."""


@dataclass(frozen=True)
class Course:
    """A command to a vehicle: fly straight to the target from that time on."""

    time_ns: int
    target: Point
    speed_mps: float


@dataclass(frozen=True)
class PreambleDetection:
    """How a radio detects the start of a frame."""

    threshold: float
    minimum_power_w: float
    duration_us: int


@dataclass(frozen=True)
class FrameCapture:
    """When a radio drops a frame for a stronger one."""

    margin: float
    window_us: int


@dataclass(frozen=True)
class Receiver:
    """The receiving half of a radio."""

    sensitivity_w: float
    energy_detection_w: float
    snir_threshold: float
    noise_figure: float = 1.0
    by_chunks: bool = False
    preamble_detection: PreambleDetection | None = None
    frame_capture: FrameCapture | None = None


@dataclass(frozen=True)
class Station:
    """One node."""

    position: Point
    tx_power_w: float
    carrier_hz: float
    bandwidth_hz: float
    op_mode: str
    bitrate_mbps: float
    receiver: Receiver
    sends: tuple[Send, ...] = ()
    courses: tuple[Course, ...] = ()


@dataclass(frozen=True)
class Air:
    """Medium between the nodes.

    `free_space_alpha` is the exponent of free space; None stands for the breakpoint model, whose numbers are
    (distance m, loss dB at 1 m, loss dB at the breakpoint, exponent before, exponent behind). The medium
    determines the model.
    """

    medium: str
    free_space_alpha: float | None
    breakpoint: tuple[float, float, float, float, float]
    noise_w: float
    temperature_k: float | None
    """None: the noise is `noise_w` everywhere; otherwise it is thermal."""


@dataclass(frozen=True)
class Case:
    """A network and its events."""

    seed: int
    rts_threshold_bytes: int
    air: Air
    stations: tuple[Station, ...]
