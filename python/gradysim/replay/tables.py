"""The tables of a replay, each column declared once.

Times are nanoseconds of simulated time, nodes are ids, positions are meters. A string is an index of the
strings of its chunk; string 0 is "". `frame` is a row of the table `frames` of the same chunk.
"""

import json
from dataclasses import dataclass
from typing import Final, Literal

from gradysim.protocol.plain_value import plain_value

ColumnType = Literal["u8", "i16", "u32", "u64", "f64"]

BYTES: Final[dict[ColumnType, int]] = {"u8": 1, "i16": 2, "u32": 4, "u64": 8, "f64": 8}
"""Bytes of a value."""

ARRAY_TYPES: Final[dict[ColumnType, str]] = {"u8": "B", "i16": "h", "u32": "I", "u64": "Q", "f64": "d"}
"""Type codes of Python's `array`."""


@dataclass(frozen=True)
class Column:
    """One column.

    Attributes:
        name: Its name in the table.
        type: Type of its values.
        delta: Whether the file has the differences of successive values, which never decrease.
    """

    name: str
    type: ColumnType
    delta: bool = False


BROADCAST: Final = 0xFFFFFFFF
"""The destination of a frame to all nodes."""

BELOW_SENSITIVITY: Final = 255
"""The outcome of a row of `receptions` whose receiver does not notice further frames of this sender."""

NO_POWER: Final = -32768
"""In a column of powers: unknown, less than -300 dBm, or no interference."""

TEXT_LEFT_OUT: Final = 0xFFFFFFFF
"""In a column of texts: the chunk has too many of them."""

MOST_BYTES_OF_TEXT: Final = 2000
"""Longer messages are cut to this size."""

MOST_TEXT_BYTES: Final = 500_000
"""Once the texts of a chunk have this size, it gets no further ones."""

FRAME_KINDS: Final = ("broadcast", "unicast", "ack", "rts", "cts")

DATA_KINDS: Final = {FRAME_KINDS.index("broadcast"), FRAME_KINDS.index("unicast")}
"""Kinds of frames that have a message."""

OUTCOMES: Final = (
    "delivered",
    "below_sensitivity",
    "noise",
    "interference",
    "receiver_transmitting",
    "receiver_locked",
    "preamble_undetected",
    "header_error",
    "captured",
    "in_air",
    "lost",
)
"""Names of the outcomes of a reception, by number. The last one occurs only in prototype mode."""

NOT_LOST: Final = frozenset({"delivered", "in_air"})
"""Outcomes in the table of receptions that are not losses."""

EVENT_KINDS: Final = ("timer", "command", "debug", "info", "warning", "error")
"""Names of the kinds of events, by number. The last four are log lines, by their level."""

TABLES: Final[dict[str, tuple[Column, ...]]] = {
    # Frames on the air, in the order of their starts.
    "frames": (
        Column("time_ns", "u64", delta=True),
        Column("duration_ns", "u64"),
        Column("node", "u32"),
        Column("interface", "u8"),
        Column("kind", "u8"),
        Column("retry", "u8"),
        Column("destination", "u32"),
        Column("bytes", "u32"),
        Column("bitrate_bps", "u32"),
        Column("power_cdbm", "i16"),  # sent, in 0.01 dBm
        Column("cause", "u32"),  # string: the callback that sent it
        Column("text", "u32"),  # the message: 0 for none, n for row n - 1 of `texts`
        Column("receptions", "u32"),  # number of receivers that noticed it
        Column("unnoticed", "u32"),  # number of those that did not: below their sensitivity
    ),
    # Outcomes at receivers, if they differ from those of the last frame of the same sender and interface
    # in this chunk. Before the first row no receiver notices a frame. `below_sensitivity` occurs here only
    # where something else than distance took the power, at the 50 strongest of each frame, and at the
    # destination. Receivers farther away only count as `unnoticed`.
    "receptions": (
        Column("frame", "u32", delta=True),
        Column("receiver", "u32"),
        Column("outcome", "u8"),
    ),
    # Why receivers lost a frame, below their sensitivity or locked on to it. Powers in 0.01 dBm, gains in
    # 0.01 dB. The path loss is what all other gains leave of the sent power.
    "losses": (
        Column("frame", "u32", delta=True),
        Column("receiver", "u32"),
        Column("power_cdbm", "i16"),
        Column("needed_cdb", "i16"),  # without noise: a power; with noise: an SINR
        Column("noise_cdbm", "i16"),  # NO_POWER if the frame was too weak, whatever the noise
        Column("interference_cdbm", "i16"),
        Column("distance_cdb", "i16"),  # path loss, only where the power is NO_POWER; otherwise 0
        Column("sender_antenna_cdb", "i16"),
        Column("receiver_antenna_cdb", "i16"),
        Column("ground_cdb", "i16"),
        Column("shadowing_cdb", "i16"),
        Column("fading_cdb", "i16"),
    ),
    # The obstacles between sender and receiver of a loss, by their index in the description of the run.
    "obstructions": (
        Column("frame", "u32", delta=True),
        Column("receiver", "u32"),
        Column("obstacle", "u32"),
        Column("gain_cdb", "i16"),
    ),
    # The nodes that caused a loss by interference, from strong to weak, with their power there.
    "interferers": (
        Column("frame", "u32", delta=True),
        Column("receiver", "u32"),
        Column("node", "u32"),
        Column("power_cdbm", "i16"),
    ),
    # Straight legs at constant speed; after its last leg a node is stationary. A chunk starts with one of
    # each node.
    "legs": (
        Column("time_ns", "u64"),
        Column("duration_ns", "u64"),
        Column("node", "u32"),
        Column("x0", "f64"),
        Column("y0", "f64"),
        Column("z0", "f64"),
        Column("x1", "f64"),
        Column("y1", "f64"),
        Column("z1", "f64"),
    ),
    # Values that protocols assigned to tracked variables.
    "variables": (
        Column("time_ns", "u64", delta=True),
        Column("node", "u32"),
        Column("name", "u32"),  # string
        Column("value", "f64"),  # NaN if it is not a number
        Column("text", "u32"),  # the value if it is not a number
    ),
    "events": (
        Column("time_ns", "u64", delta=True),
        Column("node", "u32"),
        Column("kind", "u8"),
        Column("text", "u32"),
    ),
    # The messages of the frames, each once: their beginnings one after the other in UTF-8, and their sizes.
    "texts": (
        Column("recorded", "u32"),
        Column("bytes", "u32"),  # of the whole message
    ),
    "text_bytes": (Column("byte", "u8"),),
}


def text_of_value(value: object) -> str:
    """Return the string for a tracked variable that is not a number."""
    return value if isinstance(value, str) else json.dumps(plain_value(value))
