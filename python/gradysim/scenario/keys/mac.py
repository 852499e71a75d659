"""Keys of the MAC of an 802.11 interface: its mode, rates, frame exchange and channel access."""

from gradysim.scenario.keys.interface import IEEE80211, WLAN
from gradysim.scenario.keys.key import Key
from gradysim.scenario.keys.rate_control import RATE_CONTROL_KEYS
from gradysim.scenario.keys.shapes import Below, bit_rate
from gradysim.scenario.parameter_types import boolean, choice, integer, whole_bytes

_own = Below(WLAN, "mac", IEEE80211)
_dcf = _own.below("mac.dcf")

MAC_KEYS: tuple[Key, ...] = (
    _own(
        "opMode",
        "op_mode",
        choice("b", "g(erp)", "g(mixed)", "a"),
        "Generation of IEEE 802.11, which fixes rates and timing",
    ),
    _own("bitrate", "bitrate_bps", bit_rate(), "Rate of data frames; -1bps: the fastest mandatory one"),
    _own(
        "mac.mtu",
        "mtu_bytes",
        whole_bytes(),
        "802.11: largest IP packet: 28 B of headers and the message, which is refused if it is longer",
    ),
    _dcf(
        "rateSelection.multicastFrameBitrate",
        "multicast_bitrate_bps",
        bit_rate(),
        "Rate of broadcast frames; -1bps: that of data frames",
    ),
    _dcf(
        "rateSelection.controlFrameBitrate",
        "control_bitrate_bps",
        bit_rate(),
        "Rate of RTS frames; -1bps: the fastest mandatory one",
    ),
    _dcf(
        "rtsPolicy.rtsThreshold",
        "rts_threshold_bytes",
        whole_bytes(),
        "Unicast frames of this length on begin with RTS and CTS",
    ),
    _dcf(
        "recoveryProcedure.shortRetryLimit",
        "short_retry_limit",
        integer(1),
        "Failures at which an RTS, or a frame below the RTS threshold, is given up",
    ),
    _dcf(
        "recoveryProcedure.longRetryLimit",
        "long_retry_limit",
        integer(1),
        "Failures at which a frame from the RTS threshold on is given up",
    ),
    _dcf(
        "recoveryProcedure.inetStationRetryCounters",
        "inet_station_retry_counters",
        boolean(),
        "Whether failures are counted across frames that are given up, as in INET: from the second in a row "
        "on the contention window stays large",
    ),
    _dcf(
        "channelAccess.cwMin",
        "cw_min",
        integer(-1),
        "Smallest contention window in slots; -1: that of opMode",
    ),
    _dcf(
        "channelAccess.cwMax", "cw_max", integer(-1), "Largest contention window in slots; -1: that of opMode"
    ),
    _dcf(
        "channelAccess.pendingQueue.packetCapacity",
        "queue_capacity",
        integer(1),
        "Frames that wait in the queue, without the one in progress",
    ),
    _dcf(
        "channelAccess.contention.backoffOptimization",
        "backoff_optimization",
        boolean(),
        "Whether idle time before a frame is there counts towards its wait",
    ),
    _dcf(
        "channelAccess.contention.initialChannelBusy",
        "initial_channel_busy",
        boolean(),
        "For that, whether the channel was busy until the run began; false: it has always been idle",
    ),
    _dcf(
        "channelAccess.contention.skipBackoffIfIdle",
        "skip_backoff_if_idle",
        boolean(),
        "Whether a frame that finds station and channel idle waits DIFS from then, without a backoff; the"
        " station is idle after the backoff that follows each frame",
    ),
    _dcf(
        "channelAccess.contention.inetEifs",
        "inet_eifs",
        boolean(),
        "Whether EIFS follows INET's rules, not the standard's",
    ),
    *RATE_CONTROL_KEYS,
    _own(
        "mac.rx.ownFramesSetNav",
        "own_frames_set_nav",
        boolean(),
        "Whether a node's own frames reserve the channel against itself, as in INET; not in the standard",
    ),
)
