"""Prints the events at nodes, one line for each event, in the order of their times.

      1.042371  nodes[0]  timer    greet
      1.042871  nodes[0]  tx       #7 broadcast to all: delivered at 2 of 3, 12 B, by timer greet, 'hi'
      1.043371  nodes[1]  rx       #7 broadcast from nodes[0]: delivered
      1.043371  nodes[1]  set      heard = 1

Columns: simulated time in seconds, node, event, details. #7 is the number of the frame: row 7 of the table
`frames` in a replay of the same run.
"""

import math
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from gradysim.protocol.plain_value import readable_number
from gradysim.replay.chunk import Chunk, RawChunk, unpacked
from gradysim.replay.losses import losses_of
from gradysim.replay.reader import receptions_of
from gradysim.replay.tables import BROADCAST, EVENT_KINDS, FRAME_KINDS, OUTCOMES, TEXT_LEFT_OUT

_CHUNK_S = 0.1
"""Wall time between two chunks, in seconds."""

_HELD_BACK_NS = 200_000_000
"""A frame is recorded at its end, at most this long after its start: 25 kB at 1 Mbps."""

_WIDEST_NAME = 20
_SHOWN_TEXT = 200
_TRACED_EVENTS = ("timer", "command")

# The order of lines of one instant. A reception follows its frame directly if the frame takes no time.
_TIMER, _FRAME, _RECEPTION, _COMMAND, _VARIABLE, _ANSWER = range(6)


def text_line(time_s: float, node: str, event: str, details: str, width: int) -> str:
    """Return a line of the trace, or of the log. `width` is the width of the column of nodes."""
    return f"{time_s:11.6f}  {node:{width}}  {event:7}  {details}".rstrip()


def name_width(names: Iterable[str]) -> int:
    """Return the width of the column of nodes."""
    return min(max(map(len, names), default=0), _WIDEST_NAME)


class _Line(NamedTuple):
    """A line of the trace. Lines are sorted by the first three fields."""

    time_ns: int
    rank: int
    number: int
    node: int
    event: str
    details: str


class Trace:
    """A `ReplaySink` that prints to standard output.

    Attributes:
        recorded: Ids of the nodes.
    """

    def __init__(self, nodes: Iterable[int]) -> None:
        self._nodes = frozenset(nodes)
        self.recorded: frozenset[int] | None = self._nodes
        self._lines: list[_Line] = []
        self._frames = 0
        self._values: dict[tuple[int, str], str] = {}
        self._printed_at = time.monotonic()

    def begin(self, run: Mapping[str, Any]) -> None:
        """Store the names of the nodes."""
        self._names: Sequence[str] = [node["name"] for node in run["nodes"]]
        self._obstacles: Sequence[str] = [obstacle["name"] for obstacle in run["obstacles"]]
        self._width = name_width(self._names)

    def wants_chunk(self) -> bool:
        """Return whether it is time for more lines."""
        return time.monotonic() - self._printed_at >= _CHUNK_S

    def add(self, chunk: RawChunk) -> None:
        """Print the lines up to shortly before the end of the chunk."""
        content = unpacked(chunk)
        self._lines.extend(self._lines_of_frames(content))
        self._lines.extend(self._lines_of_events(content))
        self._print(chunk.end_ns - _HELD_BACK_NS)
        self._printed_at = time.monotonic()

    def close(self, end: Mapping[str, Any]) -> None:
        """Print the other lines. Receptions that would end after the run are left out."""
        self._print(math.ceil(end["time_s"] * 1e9))

    def _print(self, until_ns: int) -> None:
        self._lines.sort(key=lambda line: line[:3])
        due = [line for line in self._lines if line.time_ns <= until_ns]
        del self._lines[: len(due)]
        texts = (
            text_line(time_ns / 1e9, self._names[node], event, _printable(details), self._width)
            for time_ns, _, _, node, event, details in due
        )
        try:
            print("".join(f"{text}\n" for text in texts), end="", flush=True)
        except BrokenPipeError:  # the run continues; the command reports it
            self._nodes = frozenset()

    def _lines_of_frames(self, chunk: Chunk) -> Iterator[_Line]:
        frames = chunk.tables["frames"]
        outcomes: list[dict[int, int]] = [{} for _ in frames["node"]]
        for frame, receiver, outcome in receptions_of(chunk):
            outcomes[frame][receiver] = outcome
        losses = {(loss.frame, loss.receiver): loss for loss in losses_of(chunk)}
        messages = chunk.messages()
        for frame, sender in enumerate(frames["node"]):
            start_ns, duration_ns = frames["time_ns"][frame], frames["duration_ns"][frame]
            is_answer = chunk.strings[frames["cause"][frame]] == "packet"
            rank = _ANSWER if is_answer else _FRAME
            number = self._frames + frame
            name = f"#{number} {FRAME_KINDS[frames['kind'][frame]]}"
            if frames["retry"][frame]:
                name += " retry"
            if sender in self._nodes:
                details = f"{name} to {self._sent(chunk, frame, outcomes[frame])}"
                text = frames["text"][frame]
                if text != TEXT_LEFT_OUT and messages[text]:
                    details += f", {_quoted(messages[text])}"
                yield _Line(start_ns, rank, number, sender, "tx", details)
            destination = frames["destination"][frame]
            source = self._names[sender]
            if frames["interface"][frame]:
                source += f".wlan[{frames['interface'][frame]}]"
            for receiver, outcome in outcomes[frame].items():
                if receiver not in self._nodes:
                    continue
                is_overheard = destination not in (BROADCAST, receiver)
                to = f" to {self._names[destination]}" if is_overheard else ""
                details = f"{name} from {source}{to}: {OUTCOMES[outcome]}"
                if (loss := losses.get((frame, receiver))) is not None:
                    details += f", {loss.words(self._names, self._obstacles, sender)}".removesuffix(", ")
                end_ns, end_rank = start_ns + duration_ns, _RECEPTION if duration_ns else rank
                yield _Line(end_ns, end_rank, number, receiver, "rx", details)
        self._frames += len(frames["node"])

    def _sent(self, chunk: Chunk, frame: int, outcomes: Mapping[int, int]) -> str:
        """Return the part after `to` of a sent frame's line."""
        frames = chunk.tables["frames"]
        destination = frames["destination"][frame]
        bitrate_bps, cause = frames["bitrate_bps"][frame], chunk.strings[frames["cause"][frame]]
        if destination == BROADCAST:
            delivered = list(outcomes.values()).count(OUTCOMES.index("delivered"))
            receivers = frames["receptions"][frame] + frames["unnoticed"][frame]
            outcome = f"delivered at {delivered} of {receivers}"
        else:
            outcome = OUTCOMES[outcomes[destination]] if destination in outcomes else "below_sensitivity"
        parts = [outcome, f"{frames['bytes'][frame]} B"]
        parts += [f"{bitrate_bps / 1e6:g} Mbps"] if bitrate_bps else []
        parts += [f"by {cause}"] if cause else []
        to = "all" if destination == BROADCAST else self._names[destination]
        return f"{to}: {', '.join(parts)}"

    def _lines_of_events(self, chunk: Chunk) -> Iterator[_Line]:
        rows = chunk.rows("events", "time_ns", "node", "kind", "text")
        for row, (time_ns, node, kind, text) in enumerate(rows):
            event = EVENT_KINDS[kind]
            if node in self._nodes and event in _TRACED_EVENTS:  # log lines are on standard error
                rank = _TIMER if event == "timer" else _COMMAND
                yield _Line(time_ns, rank, row, node, event, chunk.strings[text])
        rows = chunk.rows("variables", "time_ns", "node", "name", "value", "text")
        for row, (time_ns, node, name, number, text) in enumerate(rows):
            variable = chunk.strings[name]
            value = chunk.strings[text] if math.isnan(number) and text else f"{readable_number(number):.12g}"
            if node in self._nodes and self._values.get((node, variable)) != value:
                self._values[node, variable] = value
                yield _Line(time_ns, _VARIABLE, row, node, "set", f"{variable} = {value}")


def _printable(details: str) -> str:
    """Return a text with escapes for line ends, control characters, and what UTF-8 cannot encode."""
    if details.isprintable():
        return details
    return "".join(letter if letter.isprintable() else repr(letter)[1:-1] for letter in details)


def _quoted(message: str) -> str:
    """Return the first 200 characters of a message on one line."""
    return repr(message[:_SHOWN_TEXT]) + ("…" if len(message) > _SHOWN_TEXT else "")
