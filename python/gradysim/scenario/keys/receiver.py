"""Keys of a radio's receiver: from which level on, and when it takes up a frame or gives it up."""

from gradysim.scenario.keys.interface import WLAN
from gradysim.scenario.keys.key import HAS_TO_BE_GIVEN, Key
from gradysim.scenario.keys.radio_media import RADIO_MEDIA
from gradysim.scenario.keys.shapes import Below, level
from gradysim.scenario.parameter_types import choice, file_name, power_ratio, quantity

_own = Below(f"{WLAN}.radio.receiver", "radio", RADIO_MEDIA)
_ber_table = _own.only_for("radio.error_model", "Ieee80211BerTableErrorModel")
_thermal_noise = _own.only_for("medium.background_noise", "ThermalNoise")
_preamble = _own.only_for("radio.preamble_detection", "ThresholdPreambleDetection")
_capture = _own.only_for("radio.frame_capture", "SimpleFrameCapture")

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
    _ber_table(
        "errorModel.berTableFile",
        "ber_table_file",
        file_name(),
        "CSV of packet success over SNIR, seen from the .ini file; its format is this project's"
        " (docs/guides/receivers.md)",
        default=HAS_TO_BE_GIVEN,
    ),
    _own(
        "errorModel.snirMode",
        "snir_mode",
        choice("min", "chunks"),
        "What decides about a frame: its least SNIR, or that of every stretch of time for its part, the"
        " preamble left out (docs/guides/receivers.md)",
    ),
    _thermal_noise("noiseFigure", "noise_figure", power_ratio(), "what the receiver adds to it"),
    _own(
        "preambleDetection.typename",
        "preamble_detection",
        choice("", "ThresholdPreambleDetection"),
        'When a radio locks on to a frame; "": at once, else when it has noticed its beginning',
    ),
    _preamble(
        "preambleDetection.threshold",
        "preamble_threshold",
        power_ratio(),
        "least SNIR",
    ),
    _preamble(
        "preambleDetection.minimumPower",
        "preamble_minimum_power_w",
        level(zero=True),
        "least power of the frame",
    ),
    _preamble(
        "preambleDetection.duration",
        "preamble_duration_s",
        quantity("s", above=0, shown="us"),
        "how long a radio listens before it decides",
    ),
    _own(
        "frameCapture.typename",
        "frame_capture",
        choice("", "SimpleFrameCapture"),
        'Whether a stronger frame takes the place of one that has begun; "": never',
    ),
    _capture(
        "frameCapture.margin",
        "capture_margin",
        power_ratio(),
        "how much stronger it has to be",
    ),
    _capture(
        "frameCapture.window",
        "capture_window_s",
        quantity("s", at_least=0, shown="us"),
        "how long after the start of the other",
    ),
)
