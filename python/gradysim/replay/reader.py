"""Reader of replays."""

from array import array
from bisect import bisect_right
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

from gradysim.replay.chunk import Chunk, Values, unpack
from gradysim.replay.file import read_parts
from gradysim.replay.losses import Loss, losses_of
from gradysim.replay.paths import Paths
from gradysim.replay.tables import BELOW_SENSITIVITY, OUTCOMES, TABLES, TEXT_LEFT_OUT

_NS_PER_S = 1e9


class Reception(NamedTuple):
    """Outcome of a frame at a receiver.

    Receivers that did not notice the frame are included if something else than distance took its power.

    Attributes:
        frame: Row of the table `frames` of the whole run.
        receiver: Id of a node.
        outcome: Name of the outcome, see `OUTCOMES`.
    """

    frame: int
    receiver: int
    outcome: str


@dataclass(frozen=True)
class Replay:
    """A recorded run.

    Attributes:
        run: Description of the run: `config`, `run`, `mode`, `seed`, `duration_s`, `nodes` with `id`,
            `name` and `protocol`, and so on.
        end: End of the run, `time_s` and `complete`; None if its process was killed.
        chunks: Its chunks, by time.
    """

    run: Mapping[str, Any]
    end: Mapping[str, Any] | None
    chunks: tuple[Chunk, ...]

    @property
    def end_s(self) -> float:
        """End of the record, in seconds."""
        return self.chunks[-1].end_ns / _NS_PER_S if self.chunks else 0.0

    def table(self, name: str) -> "dict[str, Values | list[str]]":
        """Return a table of the whole run as {column: values}.

        `frame` numbers frames through the whole run, and strings are decoded. The columns are declared in
        `gradysim.replay.tables`. Only `receptions` differs: it has each reception, with the number of its
        outcome.

        Raises KeyError for a name that no table has.
        """
        if name == "receptions":
            return self._all_receptions()
        columns: dict[str, Any] = {}
        for column in TABLES[name]:
            parts: Any = [] if _is_text(name, column.name) else array(_type(self.chunks, name, column.name))
            for first, chunk in self._numbered():
                values = chunk.tables[name][column.name]
                if _is_text(name, column.name):
                    is_message = (name, column.name) == ("frames", "text")
                    texts = chunk.messages() if is_message else chunk.strings
                    parts.extend("" if index == TEXT_LEFT_OUT else texts[index] for index in values)
                elif column.name == "frame":
                    parts.extend(first + frame for frame in values)
                else:
                    parts.extend(values)
            columns[column.name] = parts
        return columns

    def receptions(self) -> Iterator[Reception]:
        """Yield each reception that was noticed or lost, by frame, then by receiver."""
        for frame, receiver, outcome in self._reception_rows():
            yield Reception(frame, receiver, OUTCOMES[outcome])

    def losses(self) -> Iterator[Loss]:
        """Yield why frames were lost, by frame: below the sensitivity, to noise or to interference."""
        for first, chunk in self._numbered():
            for loss in losses_of(chunk):
                yield replace(loss, frame=first + loss.frame)

    def outcomes(self) -> dict[str, int]:
        """Count the receptions by outcome, as in the result of the run, without `in_air`."""
        counts: Counter[str] = Counter(reception.outcome for reception in self.receptions())
        del counts["below_sensitivity"]  # some of the unnoticed ones
        unnoticed = sum(sum(chunk.tables["frames"]["unnoticed"]) for chunk in self.chunks)
        if unnoticed:
            counts["below_sensitivity"] += unnoticed
        return dict(counts)

    def positions(self, time_s: float) -> list[tuple[float, float, float]]:
        """Return the position of each node at a time, in meters, by id.

        Raises ValueError before the first chunk.
        """
        if not self.chunks or time_s < 0:
            raise ValueError(f"no position at {time_s} s: expected a time from 0 s to {self.end_s} s")
        time_ns = time_s * _NS_PER_S
        starts = [chunk.start_ns for chunk in self.chunks]
        paths = Paths(self.chunks[max(0, bisect_right(starts, time_ns) - 1)])
        return [paths.position(node, time_ns) for node in paths.nodes]

    def _all_receptions(self) -> dict[str, Any]:
        frames, receivers, outcomes = array("I"), array("I"), array("B")
        for frame, receiver, outcome in self._reception_rows():
            frames.append(frame)
            receivers.append(receiver)
            outcomes.append(outcome)
        return {"frame": frames, "receiver": receivers, "outcome": outcomes}

    def _reception_rows(self) -> Iterator[tuple[int, int, int]]:
        for first, chunk in self._numbered():
            for frame, receiver, outcome in receptions_of(chunk):
                yield first + frame, receiver, outcome

    def _numbered(self) -> Iterator[tuple[int, Chunk]]:
        """Yield the number of the first frame of each chunk, and the chunk."""
        first = 0
        for chunk in self.chunks:
            yield first, chunk
            first += len(chunk.tables["frames"]["node"])


def read_replay(path: str | Path) -> Replay:
    """Read a file of `gradysim run --replay`, also of a killed run.

    Raises ValueError if the file is not a replay, OSError if it cannot be read.
    """
    run, chunks, end = read_parts(Path(path))
    return Replay(run, end, tuple(unpack(chunk) for chunk in chunks))


def receptions_of(chunk: Chunk) -> Iterator[tuple[int, int, int]]:
    """Yield (frame, receiver, outcome) of a chunk. Its table contains only changes."""
    frames, changes = chunk.tables["frames"], chunk.tables["receptions"]
    rows = zip(changes["frame"], changes["receiver"], changes["outcome"], strict=True)
    change = next(rows, None)
    heard: dict[tuple[int, int], dict[int, int]] = {}
    for frame, sender in enumerate(zip(frames["node"], frames["interface"], strict=True)):
        outcomes = heard.setdefault(sender, {})
        while change is not None and change[0] == frame:
            _, receiver, outcome = change
            if outcome == BELOW_SENSITIVITY:
                del outcomes[receiver]
            else:
                outcomes[receiver] = outcome
            change = next(rows, None)
        for receiver, outcome in sorted(outcomes.items()):
            yield frame, receiver, outcome


def _is_text(table: str, column: str) -> bool:
    return (table, column) in {
        ("frames", "cause"),
        ("frames", "text"),
        ("variables", "name"),
        ("variables", "text"),
        ("events", "text"),
    }


def _type(chunks: tuple[Chunk, ...], table: str, column: str) -> str:
    return chunks[0].tables[table][column].typecode if chunks else "d"
