"""Recorder of prototype mode. The engine's recorder is in C++ and writes the same tables."""

import math
from collections import Counter, defaultdict
from collections.abc import Callable, Collection, Iterator
from typing import Any, Final

from gradysim.protocol.plain_value import as_float, key_text
from gradysim.protocol.position import Position
from gradysim.replay.chunk import RawChunk, raw
from gradysim.replay.tables import (
    BELOW_SENSITIVITY,
    MOST_BYTES_OF_TEXT,
    MOST_TEXT_BYTES,
    NO_POWER,
    NOT_LOST,
    OUTCOMES,
    TABLES,
    TEXT_LEFT_OUT,
    text_of_value,
)

LONGEST_CHUNK_NS: Final = 60_000_000_000
MOST_FRAMES: Final = 20_000
_BIN_NS = 250_000_000
_NS_PER_S = 1e9


class TableRecorder:
    """Records a run as the tables of a replay, in chunks of at most 60 s."""

    def __init__(self, now_s: Callable[[], float], recorded: Collection[int]) -> None:
        """Start to record.

        Args:
            now_s: Returns the simulated time in seconds.
            recorded: Ids of the nodes that are recorded in full; other nodes have only paths.
        """
        self._now_s = now_s
        self._recorded = recorded
        self._legs: dict[int, tuple[int, int, Position, Position]] = {}
        self._start_ns = 0
        self._chunks: list[RawChunk] = []
        self.cause = ""
        self._begin_chunk()

    def is_recorded(self, node: int) -> bool:
        """Return whether a node is recorded in full."""
        return node in self._recorded

    def path(self, node: int, start: Position, target: Position, speed_mps: float) -> None:
        """Record that a node moves straight from `start` (m) to `target` from now on, and stops there."""
        length_m = math.dist(start, target)
        if length_m == 0 or speed_mps == 0:
            self._add_leg(node, self._now_ns(), 0, start, start)
            return
        self._add_leg(node, self._now_ns(), round(length_m / speed_mps * _NS_PER_S), start, target)

    def sampled(self, node: int, position: Position, interval_s: float) -> None:
        """Record the position of a node, if its last one was recorded at least `interval_s` ago."""
        start_ns, duration_ns, _, last = self._legs[node]
        since_ns = start_ns + duration_ns
        if self._now_ns() - since_ns >= interval_s * _NS_PER_S:
            self._add_leg(node, since_ns, self._now_ns() - since_ns, last, position)

    def variable_set(self, node: int, name: object, value: object) -> None:
        """Record the new value of a tracked variable; None if it was removed."""
        if node not in self._recorded:
            return
        number = None if isinstance(value, bool) else as_float(value)
        self._row(
            "variables",
            time_ns=self._now_ns(),
            node=node,
            name=self._text(key_text(name)),
            value=math.nan if number is None else number,
            text=self._text(text_of_value(value)) if number is None else 0,
        )

    def event(self, node: int, kind: int, text: str) -> None:
        """Record an event of a kind of `EVENT_KINDS`, by number."""
        if node in self._recorded:
            self._row("events", time_ns=self._now_ns(), node=node, kind=kind, text=self._text(text))

    def message(
        self,
        sender: int,
        destination: int,
        kind: int,
        text: str,
        delay_s: float,
        outcomes: dict[int, int],
        out_of_range: int,
    ) -> None:
        """Record a message.

        Args:
            sender: Id of the node.
            destination: Id of a node, or `BROADCAST`.
            kind: Number of the kind, see `FRAME_KINDS`.
            text: Its content.
            delay_s: Delay until it arrives; s.
            outcomes: {receiver in range: number of the outcome}.
            out_of_range: Number of receivers that are not in range.
        """
        kept = outcomes
        if sender not in self._recorded:
            kept = {node: outcome for node, outcome in outcomes.items() if node in self._recorded}
            if not kept:
                return
        if len(self._columns["frames"]["node"]) >= MOST_FRAMES:
            self.close_chunk()
        frame = len(self._columns["frames"]["node"])
        self._row(
            "frames",
            time_ns=self._now_ns(),
            duration_ns=round(delay_s * _NS_PER_S),
            node=sender,
            interface=0,
            kind=kind,
            retry=0,
            destination=destination,
            bytes=len(text.encode(errors="replace")),
            bitrate_bps=0,
            power_cdbm=NO_POWER,
            cause=self._text(self.cause),
            text=self._message_row(text),
            receptions=len(outcomes),
            unnoticed=out_of_range,
        )
        self._write_changes(frame, sender, kept)
        bin_number = (self._now_ns() - self._start_ns) // _BIN_NS
        self._frames[bin_number] += 1
        for node, outcome in kept.items():
            self._outcomes[node, outcome] += 1
            self._lost[bin_number] += OUTCOMES[outcome] not in NOT_LOST

    def _write_changes(self, frame: int, sender: int, outcomes: dict[int, int]) -> None:
        before = self._heard_by[sender]
        for node in sorted(before.keys() | outcomes.keys()):
            outcome = outcomes.get(node, BELOW_SENSITIVITY)
            if before.get(node, BELOW_SENSITIVITY) != outcome:
                self._row("receptions", frame=frame, receiver=node, outcome=outcome)
        self._heard_by[sender] = outcomes

    def close_chunk(self) -> None:
        """End the chunk now."""
        bins = max([*self._frames, *self._lost], default=-1) + 1
        self._chunks.append(
            RawChunk(
                self._start_ns,
                self._now_ns(),
                list(self._texts),
                {
                    name: {column.name: raw(column, self._columns[name][column.name]) for column in columns}
                    for name, columns in TABLES.items()
                },
                {
                    "bin_ns": _BIN_NS,
                    "frames": [self._frames[number] for number in range(bins)],
                    "lost": [self._lost[number] for number in range(bins)],
                },
                {
                    "node": [node for node, _ in self._outcomes],
                    "outcome": [outcome for _, outcome in self._outcomes],
                    "count": list(self._outcomes.values()),
                },
            )
        )
        self._begin_chunk()

    def chunks(self, *, cut: bool, last: bool) -> Iterator[RawChunk]:
        """Return the complete chunks; `cut` ends the current one, `last` the record."""
        if cut or last:
            self.close_chunk()
        chunks, self._chunks = self._chunks, []
        yield from chunks

    def _begin_chunk(self) -> None:
        self._start_ns = self._now_ns()
        self._texts: dict[str, int] = {"": 0}
        self._messages: dict[str, int] = {}
        self._columns: dict[str, dict[str, list[Any]]] = {
            name: {column.name: [] for column in columns} for name, columns in TABLES.items()
        }
        self._heard_by: defaultdict[int, dict[int, int]] = defaultdict(dict)
        self._frames: Counter[int] = Counter()
        self._lost: Counter[int] = Counter()
        self._outcomes: Counter[tuple[int, int]] = Counter()
        for node, leg in self._legs.items():
            self._write_leg(node, *leg)

    def _add_leg(self, node: int, start_ns: int, duration_ns: int, start: Position, end: Position) -> None:
        self._legs[node] = (start_ns, duration_ns, start, end)
        self._write_leg(node, start_ns, duration_ns, start, end)

    def _write_leg(self, node: int, start_ns: int, duration_ns: int, start: Position, end: Position) -> None:
        coordinates = {f"{axis}0": value for axis, value in zip("xyz", start, strict=True)}
        coordinates |= {f"{axis}1": value for axis, value in zip("xyz", end, strict=True)}
        self._row("legs", time_ns=start_ns, duration_ns=duration_ns, node=node, **coordinates)

    def _row(self, table: str, **values: float) -> None:
        columns = self._columns[table]
        for name, value in values.items():
            columns[name].append(value)

    def close_if_long(self) -> None:
        """End the chunk if it has the maximum length; call it before an event is recorded."""
        if self._now_ns() - self._start_ns >= LONGEST_CHUNK_NS:
            self.close_chunk()

    def _text(self, text: str) -> int:
        return self._texts.setdefault(text, len(self._texts))

    def _message_row(self, text: str) -> int:
        """Return the value of the column `text` of frames, and record a message that is new."""
        recorded = self._columns["text_bytes"]["byte"]
        if text not in self._messages and len(recorded) >= MOST_TEXT_BYTES:
            return TEXT_LEFT_OUT
        number = self._messages.setdefault(text, len(self._messages) + 1)
        if number > len(self._columns["texts"]["bytes"]):
            data = text.encode(errors="replace")
            beginning = data[:MOST_BYTES_OF_TEXT].decode(errors="ignore").encode()
            self._row("texts", recorded=len(beginning), bytes=len(data))
            recorded.extend(beginning)
        return number

    def _now_ns(self) -> int:
        return round(self._now_s() * _NS_PER_S)
