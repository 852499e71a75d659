"""Keys of the MAC and the queue of an 802.15.4 interface."""

from gradysim.config.key import Key
from gradysim.config.keys.interface import WLAN
from gradysim.config.keys.shapes import Below
from gradysim.config.kinds import boolean, choice, integer, quantity

_mac = Below(f"{WLAN}.mac", "csma")
_queue = Below(f"{WLAN}.queue", "csma")

CSMA_KEYS: tuple[Key, ...] = (
    _mac("useMACAcks", "use_acks", boolean(), "802.15.4: whether unicast frames are acknowledged"),
    _mac(
        "macMaxFrameRetries",
        "max_frame_retries",
        integer(0),
        "802.15.4: how often a frame without an ACK is repeated",
    ),
    _mac(
        "macAckWaitDuration",
        "ack_wait_s",
        quantity("s", above=0, shown="us"),
        "802.15.4: how long a sender waits for the end of an ACK",
    ),
    _mac(
        "sifs",
        "sifs_s",
        quantity("s", at_least=0, shown="us"),
        "802.15.4: from the end of a frame to its ACK",
    ),
    _mac(
        "macMaxCSMABackoffs",
        "max_backoffs",
        integer(0),
        "802.15.4: further waits after the first, if the channel is busy; then the frame is given up",
    ),
    _mac(
        "backoffMethod",
        "backoff_method",
        choice("exponential", "linear", "constant"),
        "802.15.4: how the longest wait grows when the channel is busy",
    ),
    _mac("macMinBE", "min_be", integer(0), "802.15.4, exponential: the first wait is 0 to 2^BE - 1 periods"),
    _mac("macMaxBE", "max_be", integer(0), "802.15.4, exponential: BE grows by 1 up to that"),
    _mac(
        "contentionWindow",
        "contention_window",
        integer(1),
        "802.15.4, linear and constant: the first wait is 1 to that many periods",
    ),
    _mac(
        "aUnitBackoffPeriod",
        "unit_backoff_s",
        quantity("s", above=0, shown="us"),
        "802.15.4: the period in which waits are counted",
    ),
    _mac(
        "ccaDetectionTime",
        "cca_s",
        quantity("s", at_least=0, shown="us"),
        "802.15.4: how long a device listens before it sends",
    ),
    _mac(
        "ccaWholeWindow",
        "cca_whole_window",
        boolean(),
        "802.15.4: whether all of that time has to be free; in INET, its end",
    ),
    _mac(
        "aTurnaroundTime",
        "turnaround_s",
        quantity("s", at_least=0, shown="us"),
        "802.15.4: from listening to sending, deaf in between",
    ),
    _queue(
        "packetCapacity",
        "queue_capacity",
        integer(1),
        "802.15.4: frames that wait in the queue, without the one in progress",
    ),
)
