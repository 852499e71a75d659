"""Keys of the MAC and the queue of an 802.15.4 interface."""

from gradysim.scenario.keys.interface import IEEE802154, WLAN
from gradysim.scenario.keys.key import Key
from gradysim.scenario.keys.shapes import Below
from gradysim.scenario.parameter_types import boolean, choice, integer, quantity

_mac = Below(f"{WLAN}.mac", "csma", IEEE802154)
_exponential = _mac.only_for("csma.backoff_method", "exponential", shown="802.15.4, exponential")
_window = _mac.only_for("csma.backoff_method", "linear", "constant", shown="802.15.4, linear and constant")
_queue = Below(f"{WLAN}.queue", "csma", IEEE802154)

CSMA_KEYS: tuple[Key, ...] = (
    _mac(
        "useMACAcks",
        "use_acks",
        boolean(),
        "whether the interface asks for an ACK of each unicast that it sends",
    ),
    _mac(
        "macMaxFrameRetries",
        "max_frame_retries",
        integer(0),
        "how often a frame without an ACK is repeated",
    ),
    _mac(
        "macAckWaitDuration",
        "ack_wait_s",
        quantity("s", above=0, shown="us"),
        "how long a sender waits for the end of an ACK",
    ),
    _mac(
        "sifs",
        "sifs_s",
        quantity("s", at_least=0, shown="us"),
        "from the end of a frame to its ACK",
    ),
    _mac(
        "macLIFSPeriod",
        "lifs_s",
        quantity("s", at_least=0, shown="us"),
        "rest after a frame or its ACK, before the next wait; none in INET, 640us in the standard",
    ),
    _mac(
        "macMaxCSMABackoffs",
        "max_backoffs",
        integer(0),
        "further waits after the first, if the channel is busy; then the frame is given up",
    ),
    _mac(
        "backoffMethod",
        "backoff_method",
        choice("exponential", "linear", "constant"),
        "how the longest wait grows when the channel is busy",
    ),
    _exponential("macMinBE", "min_be", integer(0), "the first wait is 0 to 2^BE - 1 periods"),
    _exponential("macMaxBE", "max_be", integer(0), "BE grows by 1 up to that"),
    _window(
        "contentionWindow",
        "contention_window",
        integer(1),
        "the first wait is 1 to that many periods",
    ),
    _mac(
        "aUnitBackoffPeriod",
        "unit_backoff_s",
        quantity("s", above=0, shown="us"),
        "the period in which waits are counted",
    ),
    _mac(
        "ccaDetectionTime",
        "cca_s",
        quantity("s", at_least=0, shown="us"),
        "how long a device listens before it sends",
    ),
    _mac(
        "ccaWholeWindow",
        "cca_whole_window",
        boolean(),
        "whether all of that time has to be free; in INET, its end",
    ),
    _mac(
        "aTurnaroundTime",
        "turnaround_s",
        quantity("s", at_least=0, shown="us"),
        "from listening to sending, deaf in between",
    ),
    _queue(
        "packetCapacity",
        "queue_capacity",
        integer(1),
        "frames that wait in the queue, without the one in progress",
    ),
)
