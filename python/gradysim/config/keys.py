"""Every key and option that an .ini file may hold: where its value goes, and what it has to be.

The names are INET's and OMNeT++'s. Ranges of radio and MAC values are the engine's business, only what no
unit and no model could mean is refused here. To add a key, add a line.
"""

from dataclasses import dataclass

from gradysim.config.kinds import (
    Kind,
    boolean,
    channel_of_2_4_ghz,
    choice,
    integer,
    number,
    power_ratio,
    quantity,
    text,
    whole_bytes,
)


@dataclass(frozen=True)
class Key:
    """One parameter.

    Attributes:
        path: Below the node, or below the network for NETWORK_KEYS.
        target: "struct.field" that the value is for. Of two keys with one target, the first match wins.
        kind: What the value has to be.
    """

    path: str
    target: str
    kind: Kind

    @property
    def written(self) -> str:
        """The path as people write it in a pattern."""
        return self.path.replace("wlan[0]", "wlan[*]")

    @property
    def struct(self) -> str:
        """The first part of the target."""
        return self.target.partition(".")[0]

    @property
    def field(self) -> str:
        """The second part of the target."""
        return self.target.partition(".")[2]


_RADIO = "wlan[0].radio"
_DCF = "wlan[0].mac.dcf"
_MAX_SIM_TIME_S = 9_223_372.0
"""The engine's clock counts picoseconds in 64 bits."""

PROTOCOL_CLASS = Key("protocol.class", "protocol.class", text())

NODE_KEYS: tuple[Key, ...] = (
    PROTOCOL_CLASS,
    Key("mobility.typename", "mobility.typename", choice("MasslessMobility", "StationaryMobility")),
    Key("mobility.initialX", "position.initial_x", quantity("m")),
    Key("mobility.initialY", "position.initial_y", quantity("m")),
    Key("mobility.initialZ", "position.initial_z", quantity("m")),
    Key("mobility.lineStartX", "position.line_start_x", quantity("m")),
    Key("mobility.lineStartY", "position.line_start_y", quantity("m")),
    Key("mobility.lineStartZ", "position.line_start_z", quantity("m")),
    Key("mobility.lineStepX", "position.line_step_x", quantity("m")),
    Key("mobility.lineStepY", "position.line_step_y", quantity("m")),
    Key("mobility.lineStepZ", "position.line_step_z", quantity("m")),
    Key("mobility.speed", "mobility.speed_mps", quantity("mps", at_least=0)),
    Key("mobility.telemetryInterval", "mobility.telemetry_interval_s", quantity("s", at_least=0)),
    Key("wlan[0].opMode", "mac.op_mode", choice("b", "g(erp)", "g(mixed)", "a")),
    Key("wlan[0].bitrate", "mac.bitrate_bps", quantity("bps", above=0, special=-1)),
    Key("wlan[0].mac.mtu", "mac.mtu_bytes", whole_bytes()),
    Key(
        f"{_DCF}.rateSelection.multicastFrameBitrate",
        "mac.multicast_bitrate_bps",
        quantity("bps", above=0, special=-1),
    ),
    Key(
        f"{_DCF}.rateSelection.controlFrameBitrate",
        "mac.control_bitrate_bps",
        quantity("bps", above=0, special=-1),
    ),
    Key(f"{_DCF}.rtsPolicy.rtsThreshold", "mac.rts_threshold_bytes", whole_bytes()),
    Key(f"{_DCF}.recoveryProcedure.shortRetryLimit", "mac.short_retry_limit", integer(1)),
    Key(f"{_DCF}.recoveryProcedure.longRetryLimit", "mac.long_retry_limit", integer(1)),
    Key(f"{_DCF}.channelAccess.cwMin", "mac.cw_min", integer(-1)),
    Key(f"{_DCF}.channelAccess.cwMax", "mac.cw_max", integer(-1)),
    Key(f"{_DCF}.channelAccess.pendingQueue.packetCapacity", "mac.queue_capacity", integer(1)),
    Key(f"{_DCF}.channelAccess.contention.backoffOptimization", "mac.backoff_optimization", boolean()),
    Key("wlan[0].mac.rx.ownFramesSetNav", "mac.own_frames_set_nav", boolean()),
    Key(f"{_RADIO}.channelNumber", "radio.carrier_hz", channel_of_2_4_ghz()),
    Key(f"{_RADIO}.centerFrequency", "radio.carrier_hz", quantity("Hz", above=0)),
    Key(f"{_RADIO}.bandwidth", "radio.bandwidth_hz", quantity("Hz", above=0)),
    Key(f"{_RADIO}.transmitter.power", "radio.tx_power_w", quantity("W", at_least=0)),
    Key(f"{_RADIO}.transmitter.communicationRange", "radio.communication_range_m", quantity("m", at_least=0)),
    Key(f"{_RADIO}.receiver.sensitivity", "radio.sensitivity_w", quantity("W", above=0)),
    Key(f"{_RADIO}.receiver.energyDetection", "radio.energy_detection_w", quantity("W", above=0)),
    Key(f"{_RADIO}.receiver.snirThreshold", "radio.snir_threshold", power_ratio()),
    Key(f"{_RADIO}.receiver.errorModel.typename", "radio.error_model", choice("Ieee80211NistErrorModel")),
    Key(f"{_RADIO}.antenna.typename", "radio.antenna", choice("IsotropicAntenna")),
)

NETWORK_KEYS: tuple[Key, ...] = (
    Key(
        "radioMedium.typename",
        "medium.typename",
        choice("Ieee80211ScalarRadioMedium", "Ieee802154NarrowbandScalarRadioMedium", "UnitDiskRadioMedium"),
    ),
    Key("radioMedium.backgroundNoise.power", "medium.background_noise_w", quantity("W", at_least=0)),
    Key(
        "radioMedium.pathLoss.typename", "medium.path_loss", choice("FreeSpacePathLoss", "BreakpointPathLoss")
    ),
    Key("radioMedium.pathLoss.alpha", "medium.alpha", number(above=0)),
    Key("radioMedium.pathLoss.breakpointDistance", "medium.breakpoint_distance_m", quantity("m", above=0)),
    Key("radioMedium.pathLoss.l01", "medium.l01_db", quantity("dB")),
    Key("radioMedium.pathLoss.l02", "medium.l02_db", quantity("dB")),
    Key("radioMedium.pathLoss.alpha1", "medium.alpha1", number(above=0)),
    Key("radioMedium.pathLoss.alpha2", "medium.alpha2", number(above=0)),
    Key("radioMedium.propagation.typename", "medium.propagation", choice("ConstantSpeedPropagation")),
    Key(
        "communicationMedium.transmissionRange",
        "communication_medium.transmission_range_m",
        quantity("m", at_least=0),
    ),
    Key("communicationMedium.delay", "communication_medium.delay_s", quantity("s", at_least=0)),
    Key(
        "communicationMedium.failureRate", "communication_medium.failure_rate", number(at_least=0, at_most=1)
    ),
    Key(
        "coordinateSystem.sceneLatitude", "reference.latitude_deg", quantity("deg", at_least=-90, at_most=90)
    ),
    Key(
        "coordinateSystem.sceneLongitude",
        "reference.longitude_deg",
        quantity("deg", at_least=-180, at_most=180),
    ),
    Key("coordinateSystem.sceneAltitude", "reference.altitude_m", quantity("m")),
)

GROUP_SIZE = Key("count", "group.count", integer(0, 1_000_000))
"""Below the group, `*.uavs.count`; `*.numUavs` means the same."""

NETWORK_MODULES = frozenset(key.path.partition(".")[0] for key in NETWORK_KEYS)
"""Names below the network that are no groups of nodes."""

OPTIONS: dict[str, Kind] = {
    "sim-time-limit": quantity("s", above=0, at_most=_MAX_SIM_TIME_S),
    "seed-set": integer(0, 2**63 - 1),
    "repeat": integer(1, 1_000_000),
    "description": text(),
}

SECTION_OPTIONS = ("extends", "abstract")
"""Options that belong to a section and cannot be given on the command line."""

IGNORED_OPTIONS = ("network", "result-dir", "experiment-label", "cmdenv-*", "qtenv-*")
"""Options of OMNeT++ that files share with it. `network` is only the name that paths begin with."""

IGNORED_ENDS = ("cmdenv-", "qtenv-")
"""Options of OMNeT++ that are given per module, such as `**.cmdenv-log-level`."""

IGNORED_MODULES = ("visualizer",)
"""Names below the network whose parameters are OMNeT++'s alone."""
