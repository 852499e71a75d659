"""Every key and option that an .ini file may hold: where its value goes, and what it has to be.

The names are INET's and OMNeT++'s. Ranges of radio and MAC values are the engine's business, only what no
unit and no model could mean is refused here. To add a key, add a line.
"""

from gradysim.config.antenna_keys import ANTENNA_KEYS
from gradysim.config.environment_keys import ENVIRONMENT_KEYS
from gradysim.config.key import Key
from gradysim.config.kinds import (
    Kind,
    boolean,
    channel_of_2_4_ghz,
    choice,
    coordinate,
    file_name,
    integer,
    number,
    power_ratio,
    quantity,
    si_number,
    text,
    whole_bytes,
)

_RADIO = "wlan[0].radio"
_MAC = "wlan[0].mac"
_DCF = f"{_MAC}.dcf"
_MAX_SIM_TIME_S = 9_223_372.0
"""The engine's clock counts picoseconds in 64 bits."""


PROTOCOL_CLASS = Key(
    "protocol.class",
    "protocol.class",
    text(),
    'What the node runs: "file.py:Class", seen from the .ini file, or "package.module:Class"',
    default="none: it has to be given",
)

PROTOCOL_TYPENAME = Key(
    "protocol.typename",
    "protocol.typename",
    text(),
    "Instead of a class one of the engine's own protocols, listed below; integrated mode only",
    default="none",
)

PROTOCOL_KEYS = (PROTOCOL_CLASS, PROTOCOL_TYPENAME)
"""The two ways to say what a node runs; of both the first match wins."""

NODE_KEYS: tuple[Key, ...] = (
    *PROTOCOL_KEYS,
    Key(
        "mobility.typename",
        "mobility.typename",
        choice("MasslessMobility", "StationaryMobility"),
        "How it moves: as its protocol says, or not at all",
    ),
    Key(
        "mobility.initialX",
        "position.initial_x",
        coordinate(),
        "Where it starts, x; of initialX and lineStartX/lineStepX the one that is written first is in force",
        default="0m",
    ),
    Key(
        "mobility.initialY",
        "position.initial_y",
        coordinate(),
        "The same for y",
        default="0m",
    ),
    Key(
        "mobility.initialZ",
        "position.initial_z",
        coordinate(),
        "The same for z: height",
        default="0m",
    ),
    Key(
        "mobility.lineStartX",
        "position.line_start_x",
        coordinate(),
        "Nodes in a line: x of the node with index 0",
        default="0m",
    ),
    Key(
        "mobility.lineStartY",
        "position.line_start_y",
        coordinate(),
        "The same for y",
        default="0m",
    ),
    Key(
        "mobility.lineStartZ",
        "position.line_start_z",
        coordinate(),
        "The same for z",
        default="0m",
    ),
    Key(
        "mobility.lineStepX",
        "position.line_step_x",
        quantity("m"),
        "Nodes in a line: x from one index to the next",
        default="0m",
    ),
    Key(
        "mobility.lineStepY",
        "position.line_step_y",
        quantity("m"),
        "The same for y",
        default="0m",
    ),
    Key(
        "mobility.lineStepZ",
        "position.line_step_z",
        quantity("m"),
        "The same for z",
        default="0m",
    ),
    Key(
        "mobility.speed",
        "mobility.speed_mps",
        quantity("mps", at_least=0),
        "Speed until the protocol sets another",
    ),
    Key(
        "mobility.telemetryInterval",
        "mobility.telemetry_interval_s",
        quantity("s", at_least=0, shown="ms"),
        "Time between two calls of handle_telemetry; 0s for none",
    ),
    Key(
        "mobility.initialHeading",
        "mobility.initial_heading_rad",
        quantity("rad", shown="deg"),
        "How it is turned at the start: from x towards y",
    ),
    Key(
        "mobility.initialElevation",
        "mobility.initial_elevation_rad",
        quantity("rad", shown="deg"),
        "The same upwards",
    ),
    Key(
        "mobility.initialBank",
        "mobility.initial_bank_rad",
        quantity("rad", shown="deg"),
        "The same about its own x axis, from y towards z",
    ),
    Key(
        "mobility.faceForward",
        "mobility.face_forward",
        boolean(),
        "Whether heading and elevation follow the direction of flight",
    ),
    Key(
        "wlan[0].typename",
        "node.interface",
        choice("Ieee80211Interface", "Ieee802154NarrowbandInterface"),
        "Its network interface: a station of 802.11, or a device of 802.15.4, whose radio has other defaults",
    ),
    Key(
        "wlan[0].opMode",
        "mac.op_mode",
        choice("b", "g(erp)", "g(mixed)", "a"),
        "Generation of IEEE 802.11, which fixes rates and timing",
    ),
    Key(
        "wlan[0].bitrate",
        "mac.bitrate_bps",
        quantity("bps", above=0, special=-1, shown="Mbps"),
        "Rate of data frames; -1bps: the fastest mandatory one",
    ),
    Key(
        "wlan[0].mac.mtu",
        "mac.mtu_bytes",
        whole_bytes(),
        "802.11: largest IP packet: 28 B of headers and the message, which is refused if it is longer",
    ),
    Key(
        f"{_DCF}.rateSelection.multicastFrameBitrate",
        "mac.multicast_bitrate_bps",
        quantity("bps", above=0, special=-1, shown="Mbps"),
        "Rate of broadcast frames; -1bps: that of data frames",
    ),
    Key(
        f"{_DCF}.rateSelection.controlFrameBitrate",
        "mac.control_bitrate_bps",
        quantity("bps", above=0, special=-1, shown="Mbps"),
        "Rate of RTS frames; -1bps: the fastest mandatory one",
    ),
    Key(
        f"{_DCF}.rtsPolicy.rtsThreshold",
        "mac.rts_threshold_bytes",
        whole_bytes(),
        "Unicast frames of this length on begin with RTS and CTS",
    ),
    Key(
        f"{_DCF}.recoveryProcedure.shortRetryLimit",
        "mac.short_retry_limit",
        integer(1),
        "Failures at which an RTS, or a frame below the RTS threshold, is given up",
    ),
    Key(
        f"{_DCF}.recoveryProcedure.longRetryLimit",
        "mac.long_retry_limit",
        integer(1),
        "Failures at which a frame from the RTS threshold on is given up",
    ),
    Key(
        f"{_DCF}.channelAccess.cwMin",
        "mac.cw_min",
        integer(-1),
        "Smallest contention window in slots; -1: that of opMode",
    ),
    Key(
        f"{_DCF}.channelAccess.cwMax",
        "mac.cw_max",
        integer(-1),
        "Largest contention window in slots; -1: that of opMode",
    ),
    Key(
        f"{_DCF}.channelAccess.pendingQueue.packetCapacity",
        "mac.queue_capacity",
        integer(1),
        "Frames that wait in the queue, without the one in progress",
    ),
    Key(
        f"{_DCF}.channelAccess.contention.backoffOptimization",
        "mac.backoff_optimization",
        boolean(),
        "Whether idle time before a frame is there counts towards its wait",
    ),
    Key(
        f"{_DCF}.channelAccess.contention.skipBackoffIfIdle",
        "mac.skip_backoff_if_idle",
        boolean(),
        "Whether a frame that finds station and channel idle waits DIFS from then, without a backoff",
    ),
    Key(
        f"{_DCF}.rateControl.typename",
        "mac.rate_control",
        choice("", "ArfRateControl", "AarfRateControl", "MinstrelRateControl"),
        'How the rate of unicast frames follows the losses; "": not at all',
    ),
    Key(
        f"{_DCF}.rateControl.initialRate",
        "mac.initial_rate_bps",
        quantity("bps", above=0, special=-1, shown="Mbps"),
        "Rate of the first frame to a node; -1bps: that of data frames",
    ),
    Key(
        f"{_DCF}.rateControl.interval",
        "mac.rate_interval_s",
        quantity("s", at_least=1e-6, shown="ms"),
        "ARF, AARF: time after the last change at which the next faster rate is tried",
    ),
    Key(
        f"{_DCF}.rateControl.increaseThreshold",
        "mac.increase_threshold",
        integer(1),
        "ARF, AARF: successes in a row that lead to the next faster rate",
    ),
    Key(
        f"{_DCF}.rateControl.decreaseThreshold",
        "mac.decrease_threshold",
        integer(1),
        "ARF, AARF: failures in a row that lead to the next slower rate",
    ),
    Key(
        f"{_DCF}.rateControl.increaseThresholdFactor",
        "mac.increase_threshold_factor",
        number(at_least=1),
        "AARF: by how much increaseThreshold grows when the faster rate fails at once",
    ),
    Key(
        f"{_DCF}.rateControl.maxIncreaseThreshold",
        "mac.max_increase_threshold",
        integer(1),
        "AARF: up to where it grows",
    ),
    Key(
        f"{_DCF}.rateControl.updateInterval",
        "mac.rate_update_interval_s",
        quantity("s", at_least=1e-6, shown="ms"),
        "Minstrel: time from one choice of the best rates to the next",
    ),
    Key(
        f"{_DCF}.rateControl.lookAroundRate",
        "mac.look_around_share",
        number(at_least=0, at_most=1),
        "Minstrel: part of the frames that try a rate drawn at random, 0 to 1",
    ),
    Key(
        f"{_DCF}.rateControl.ewmaWeight",
        "mac.ewma_weight",
        number(at_least=0, at_most=0.999999),
        "Minstrel: weight of the past in the mean share of successes",
    ),
    Key(
        "wlan[0].mac.rx.ownFramesSetNav",
        "mac.own_frames_set_nav",
        boolean(),
        "Whether a node's own frames reserve the channel against itself, as in INET; not in the standard",
    ),
    Key(
        f"{_MAC}.useMACAcks",
        "csma.use_acks",
        boolean(),
        "802.15.4: whether unicast frames are acknowledged",
    ),
    Key(
        f"{_MAC}.macMaxFrameRetries",
        "csma.max_frame_retries",
        integer(0),
        "802.15.4: how often a frame without an ACK is repeated",
    ),
    Key(
        f"{_MAC}.macAckWaitDuration",
        "csma.ack_wait_s",
        quantity("s", above=0, shown="us"),
        "802.15.4: how long a sender waits for the end of an ACK",
    ),
    Key(
        f"{_MAC}.sifs",
        "csma.sifs_s",
        quantity("s", at_least=0, shown="us"),
        "802.15.4: from the end of a frame to its ACK",
    ),
    Key(
        f"{_MAC}.macMaxCSMABackoffs",
        "csma.max_backoffs",
        integer(0),
        "802.15.4: further waits after the first, if the channel is busy; then the frame is given up",
    ),
    Key(
        f"{_MAC}.backoffMethod",
        "csma.backoff_method",
        choice("exponential", "linear", "constant"),
        "802.15.4: how the longest wait grows when the channel is busy",
    ),
    Key(
        f"{_MAC}.macMinBE",
        "csma.min_be",
        integer(0),
        "802.15.4, exponential: the first wait is 0 to 2^BE - 1 periods",
    ),
    Key(
        f"{_MAC}.macMaxBE",
        "csma.max_be",
        integer(0),
        "802.15.4, exponential: BE grows by 1 up to that",
    ),
    Key(
        f"{_MAC}.contentionWindow",
        "csma.contention_window",
        integer(1),
        "802.15.4, linear and constant: the first wait is 1 to that many periods",
    ),
    Key(
        f"{_MAC}.aUnitBackoffPeriod",
        "csma.unit_backoff_s",
        quantity("s", above=0, shown="us"),
        "802.15.4: the period in which waits are counted",
    ),
    Key(
        f"{_MAC}.ccaDetectionTime",
        "csma.cca_s",
        quantity("s", at_least=0, shown="us"),
        "802.15.4: how long a device listens before it sends",
    ),
    Key(
        f"{_MAC}.ccaWholeWindow",
        "csma.cca_whole_window",
        boolean(),
        "802.15.4: whether all of that time has to be free; in INET, its end",
    ),
    Key(
        f"{_MAC}.aTurnaroundTime",
        "csma.turnaround_s",
        quantity("s", at_least=0, shown="us"),
        "802.15.4: from listening to sending, deaf in between",
    ),
    Key(
        "wlan[0].queue.packetCapacity",
        "csma.queue_capacity",
        integer(1),
        "802.15.4: frames that wait in the queue, without the one in progress",
    ),
    Key(
        f"{_RADIO}.channelNumber",
        "radio.carrier_hz",
        channel_of_2_4_ghz(),
        "802.11: channel of the 2.4 GHz band, counted from 0 (another way to set centerFrequency)",
    ),
    Key(
        f"{_RADIO}.centerFrequency",
        "radio.carrier_hz",
        quantity("Hz", above=0, shown="MHz"),
        "Centre of the channel",
    ),
    Key(
        f"{_RADIO}.bandwidth",
        "radio.bandwidth_hz",
        quantity("Hz", above=0, shown="MHz"),
        "Width of the channel",
    ),
    Key(
        f"{_RADIO}.transmitter.power",
        "radio.tx_power_w",
        quantity("W", at_least=0, shown="mW"),
        "Power that is sent",
    ),
    Key(
        f"{_RADIO}.transmitter.communicationRange",
        "radio.communication_range_m",
        quantity("m", at_least=0),
        "UnitDiskRadioMedium: radius of the circle. Other media: sets the power for which half of the"
        " broadcast messages of 50 B arrive there; of it and transmitter.power the first line is in force",
    ),
    Key(
        f"{_RADIO}.receiver.sensitivity",
        "radio.sensitivity_w",
        quantity("W", above=0, shown="dBm"),
        "Weakest frame that is received at all",
    ),
    Key(
        f"{_RADIO}.receiver.energyDetection",
        "radio.energy_detection_w",
        quantity("W", above=0, shown="dBm"),
        "Power from which on the channel counts as busy",
    ),
    Key(
        f"{_RADIO}.receiver.snirThreshold",
        "radio.snir_threshold",
        power_ratio(),
        "Signal to noise and interference at or below which every frame is lost",
    ),
    Key(
        f"{_RADIO}.receiver.errorModel.typename",
        "radio.error_model",
        choice("Ieee80211NistErrorModel", "Ieee80211BerTableErrorModel", "Ieee802154ErrorModel"),
        "How noise becomes lost frames",
    ),
    Key(
        f"{_RADIO}.receiver.errorModel.berTableFile",
        "radio.ber_table_file",
        file_name(),
        "Ieee80211BerTableErrorModel: CSV of packet success over SNIR, seen from the .ini file",
    ),
    Key(
        f"{_RADIO}.receiver.errorModel.snirMode",
        "radio.snir_mode",
        choice("min", "chunks"),
        "What decides about a frame: its least SNIR, or that of every stretch of time for its part",
    ),
    Key(
        f"{_RADIO}.receiver.noiseFigure",
        "radio.noise_figure",
        power_ratio(),
        "ThermalNoise: what the receiver adds to it",
    ),
    Key(
        f"{_RADIO}.receiver.preambleDetection.typename",
        "radio.preamble_detection",
        choice("", "ThresholdPreambleDetection"),
        'When a radio locks on to a frame; "": at once, else when it has noticed its beginning',
    ),
    Key(
        f"{_RADIO}.receiver.preambleDetection.threshold",
        "radio.preamble_threshold",
        power_ratio(),
        "ThresholdPreambleDetection: least SNIR",
    ),
    Key(
        f"{_RADIO}.receiver.preambleDetection.minimumPower",
        "radio.preamble_minimum_power_w",
        quantity("W", at_least=0, shown="dBm"),
        "ThresholdPreambleDetection: least power of the frame",
    ),
    Key(
        f"{_RADIO}.receiver.preambleDetection.duration",
        "radio.preamble_duration_s",
        quantity("s", above=0, shown="us"),
        "ThresholdPreambleDetection: how long a radio listens before it decides",
    ),
    Key(
        f"{_RADIO}.receiver.frameCapture.typename",
        "radio.frame_capture",
        choice("", "SimpleFrameCapture"),
        'Whether a stronger frame takes the place of one that has begun; "": never',
    ),
    Key(
        f"{_RADIO}.receiver.frameCapture.margin",
        "radio.capture_margin",
        power_ratio(),
        "SimpleFrameCapture: how much stronger it has to be",
    ),
    Key(
        f"{_RADIO}.receiver.frameCapture.window",
        "radio.capture_window_s",
        quantity("s", at_least=0, shown="us"),
        "SimpleFrameCapture: how long after the start of the other",
    ),
    *ANTENNA_KEYS,
)

NETWORK_KEYS: tuple[Key, ...] = (
    Key(
        "radioMedium.typename",
        "medium.typename",
        choice("Ieee80211ScalarRadioMedium", "Ieee802154NarrowbandScalarRadioMedium", "UnitDiskRadioMedium"),
        "The model of the air: path loss and noise, or a circle",
    ),
    Key(
        "radioMedium.backgroundNoise.typename",
        "medium.background_noise",
        choice("IsotropicScalarBackgroundNoise", "ThermalNoise"),
        "The noise in a channel: one power for all, or that of the receiver's bandwidth",
    ),
    Key(
        "radioMedium.backgroundNoise.power",
        "medium.background_noise_w",
        quantity("W", at_least=0, shown="dBm"),
        "IsotropicScalarBackgroundNoise: noise in the channel",
    ),
    Key(
        "radioMedium.backgroundNoise.temperature",
        "medium.temperature_k",
        quantity("K", at_least=0),
        "ThermalNoise: temperature of the receiver's surroundings",
    ),
    Key(
        "radioMedium.pathLoss.typename",
        "medium.path_loss",
        choice(
            "FreeSpacePathLoss",
            "BreakpointPathLoss",
            "TwoRayGroundReflection",
            "TwoRayInterference",
            "LogNormalShadowing",
            "RayleighFading",
            "RicianFading",
            "NakagamiFading",
        ),
        "How power falls with distance, and how it fades; docs/guides/propagation.md",
    ),
    Key(
        "radioMedium.pathLoss.alpha",
        "medium.alpha",
        number(above=0),
        "Exponent of the distance; all but BreakpointPathLoss and TwoRayInterference",
    ),
    Key(
        "radioMedium.pathLoss.breakpointDistance",
        "medium.breakpoint_distance_m",
        quantity("m", above=0),
        "BreakpointPathLoss: distance at which the exponent changes",
    ),
    Key(
        "radioMedium.pathLoss.l01",
        "medium.l01_db",
        quantity("dB"),
        "BreakpointPathLoss: loss at 1 m",
    ),
    Key(
        "radioMedium.pathLoss.l02",
        "medium.l02_db",
        quantity("dB"),
        "BreakpointPathLoss: loss at the breakpoint",
    ),
    Key(
        "radioMedium.pathLoss.alpha1",
        "medium.alpha1",
        number(above=0),
        "BreakpointPathLoss: exponent before the breakpoint",
    ),
    Key(
        "radioMedium.pathLoss.alpha2",
        "medium.alpha2",
        number(above=0),
        "BreakpointPathLoss: exponent behind the breakpoint",
    ),
    Key(
        "radioMedium.pathLoss.epsilon_r",
        "medium.epsilon_r",
        number(at_least=1),
        "TwoRayInterference: relative permittivity of the ground",
    ),
    Key(
        "radioMedium.pathLoss.polarization",
        "medium.polarization",
        choice("horizontal", "vertical"),
        "TwoRayInterference: of the antennas",
    ),
    Key(
        "radioMedium.pathLoss.sigma",
        "medium.sigma_db",
        number(at_least=0),
        "LogNormalShadowing: standard deviation in dB, as a plain number",
    ),
    Key(
        "radioMedium.pathLoss.k",
        "medium.k_db",
        quantity("dB"),
        "RicianFading: power of the line of sight over that of all other ways",
    ),
    Key(
        "radioMedium.pathLoss.shapeFactor",
        "medium.shape_factor",
        number(at_least=0.5),
        "NakagamiFading: m; the less, the deeper the fades",
    ),
    Key(
        "radioMedium.pathLoss.coherenceTime",
        "medium.coherence_time_s",
        quantity("s", at_least=0, special=-1, shown="ms"),
        "Time in which fading changes; 0s: with each frame, as in INET; -1s: 5 ms, shadowing 1 s",
    ),
    Key(
        "radioMedium.propagation.typename",
        "medium.propagation",
        choice("ConstantSpeedPropagation"),
        "How frames travel: with the speed of light",
    ),
    *ENVIRONMENT_KEYS,
    Key(
        "communicationMedium.transmissionRange",
        "communication_medium.transmission_range_m",
        quantity("m", at_least=0),
        "Prototype mode: distance up to which a message arrives",
    ),
    Key(
        "communicationMedium.delay",
        "communication_medium.delay_s",
        quantity("s", at_least=0),
        "Prototype mode: time from sending to arrival",
    ),
    Key(
        "communicationMedium.failureRate",
        "communication_medium.failure_rate",
        number(at_least=0, at_most=1),
        "Prototype mode: part of the messages that is lost, 0 to 1",
    ),
    Key(
        "coordinateSystem.sceneLatitude",
        "reference.latitude_deg",
        quantity("deg", at_least=-90, at_most=90),
        "Latitude of the origin, for geographic coordinates",
        default="0deg",
    ),
    Key(
        "coordinateSystem.sceneLongitude",
        "reference.longitude_deg",
        quantity("deg", at_least=-180, at_most=180),
        "Longitude of the origin",
        default="0deg",
    ),
    Key(
        "coordinateSystem.sceneAltitude",
        "reference.altitude_m",
        quantity("m"),
        "Altitude of the origin",
        default="0m",
    ),
)

GROUP_SIZE = Key(
    "count",
    "group.count",
    integer(0, 1_000_000),
    "Number of nodes of the group; `*.numUavs` says the same. neither: one node, no index",
    default="none",
)
"""Below the group, `*.uavs.count`; `*.numUavs` means the same."""

PROTOCOL_PARAMETER = Key(
    "protocol.ATTRIBUTE",
    "protocol.attribute",
    si_number(),
    "A public class attribute of the protocol, int, float, str or bool; quantities become SI units",
    default="the class's",
)
"""Stands for all of them in lists of keys; `parameters_of` knows a class's."""

NETWORK_MODULES = frozenset(key.path.partition(".")[0] for key in NETWORK_KEYS)
"""Names below the network that are no groups of nodes."""

OPTION_KEYS: tuple[Key, ...] = (
    Key(
        "sim-time-limit",
        "option.sim_time_limit",
        quantity("s", above=0, at_most=_MAX_SIM_TIME_S),
        "Simulated time at which a run ends",
        default="none: it has to be given",
    ),
    Key(
        "seed-set",
        "option.seed_set",
        integer(0, 2**63 - 1),
        "Seed of all random numbers of a run",
        default="${runnumber}",
    ),
    Key(
        "repeat",
        "option.repeat",
        integer(1, 1_000_000),
        "How many runs there are, from number 0",
        default="1",
    ),
    Key("description", "option.description", text(), "What the configuration is about", default='""'),
)

OPTIONS: dict[str, Kind] = {key.path: key.kind for key in OPTION_KEYS}

SECTION_OPTIONS = ("extends", "abstract")
"""Options that belong to a section and cannot be given on the command line."""

IGNORED_OPTIONS = ("network", "result-dir", "experiment-label", "cmdenv-*", "qtenv-*")
"""Options of OMNeT++ that files share with it. `network` is only the name that paths begin with."""

IGNORED_ENDS = ("cmdenv-", "qtenv-")
"""Options of OMNeT++ that are given per module, such as `**.cmdenv-log-level`."""

IGNORED_MODULES = ("visualizer",)
"""Names below the network whose parameters are OMNeT++'s alone."""
