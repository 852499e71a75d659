"""Keys of a radio's receiver: from which level on, and when it takes up a frame or gives it up."""

from gradysim.config.key import Key
from gradysim.config.keys.interface import WLAN
from gradysim.config.keys.shapes import Below, level
from gradysim.config.kinds import choice, file_name, power_ratio, quantity

_own = Below(f"{WLAN}.radio.receiver", "radio")

RECEIVER_KEYS: tuple[Key, ...] = (
    _own("sensitivity", "sensitivity_w", level(), "Weakest frame that is received at all"),
    _own("energyDetection", "energy_detection_w", level(), "Power from which on the channel counts as busy"),
    _own(
        "snirThreshold",
        "snir_threshold",
        power_ratio(),
        "Signal to noise and interference at or below which every frame is lost",
    ),
    _own(
        "errorModel.typename",
        "error_model",
        choice("Ieee80211NistErrorModel", "Ieee80211BerTableErrorModel", "Ieee802154ErrorModel"),
        "How noise becomes lost frames",
    ),
    _own(
        "errorModel.berTableFile",
        "ber_table_file",
        file_name(),
        "Ieee80211BerTableErrorModel: CSV of packet success over SNIR, seen from the .ini file",
    ),
    _own(
        "errorModel.snirMode",
        "snir_mode",
        choice("min", "chunks"),
        "What decides about a frame: its least SNIR, or that of every stretch of time for its part",
    ),
    _own("noiseFigure", "noise_figure", power_ratio(), "ThermalNoise: what the receiver adds to it"),
    _own(
        "preambleDetection.typename",
        "preamble_detection",
        choice("", "ThresholdPreambleDetection"),
        'When a radio locks on to a frame; "": at once, else when it has noticed its beginning',
    ),
    _own(
        "preambleDetection.threshold",
        "preamble_threshold",
        power_ratio(),
        "ThresholdPreambleDetection: least SNIR",
    ),
    _own(
        "preambleDetection.minimumPower",
        "preamble_minimum_power_w",
        quantity("W", at_least=0, shown="dBm"),
        "ThresholdPreambleDetection: least power of the frame",
    ),
    _own(
        "preambleDetection.duration",
        "preamble_duration_s",
        quantity("s", above=0, shown="us"),
        "ThresholdPreambleDetection: how long a radio listens before it decides",
    ),
    _own(
        "frameCapture.typename",
        "frame_capture",
        choice("", "SimpleFrameCapture"),
        'Whether a stronger frame takes the place of one that has begun; "": never',
    ),
    _own(
        "frameCapture.margin",
        "capture_margin",
        power_ratio(),
        "SimpleFrameCapture: how much stronger it has to be",
    ),
    _own(
        "frameCapture.window",
        "capture_window_s",
        quantity("s", at_least=0, shown="us"),
        "SimpleFrameCapture: how long after the start of the other",
    ),
)
