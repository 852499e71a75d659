"""One scenario for the oracle of reception: plain data, which the engine and the oracle are both given.

Powers are in watts, ratios linear, times in whole nanoseconds.
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
    """An order to a vehicle: from that time on straight to the target."""

    time_ns: int
    target: Point
    speed_mps: float


@dataclass(frozen=True)
class PreambleDetection:
    """How a radio notices that a frame begins."""

    threshold: float
    minimum_power_w: float
    duration_us: int


@dataclass(frozen=True)
class FrameCapture:
    """When a radio gives a frame up for a stronger one."""

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
    """What is between the nodes.

    `free_space_alpha` is the exponent of free space; None stands for the breakpoint model, whose numbers are
    (distance m, loss dB at 1 m, loss dB at the breakpoint, exponent before, exponent behind). The medium says
    which of them it is.
    """

    medium: str
    free_space_alpha: float | None
    breakpoint: tuple[float, float, float, float, float]
    noise_w: float
    temperature_k: float | None
    """None: the noise is `noise_w` everywhere; else it is thermal."""


@dataclass(frozen=True)
class Case:
    """A network and what happens in it."""

    seed: int
    rts_threshold_bytes: int
    air: Air
    stations: tuple[Station, ...]
