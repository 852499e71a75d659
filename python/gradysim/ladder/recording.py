"""A recorded run: its replay, and the callbacks of its protocols with the messages that caused them."""

import pickle
from bisect import bisect_left
from collections import Counter, defaultdict, deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from gradysim.integrated.network import node_config
from gradysim.ladder.callbacks import Callback, CallbackLog, Cause
from gradysim.ladder.campaign import Campaign, Effects
from gradysim.replay.reader import Replay, read_replay
from gradysim.replay.tables import BROADCAST, DATA_KINDS, OUTCOMES

if TYPE_CHECKING:
    from gradysim._netsim import InterfaceConfig

_DELIVERED = OUTCOMES.index("delivered")
_LONGEST_WAY_NS = 100_000
"""Time that a frame takes over 30 km."""


@dataclass(frozen=True)
class Recorded:
    """What a run left behind, next to its replay.

    Attributes:
        log: Callbacks of the protocols.
        messages: {outcome: messages}.
        queue_capacity: {node: number of messages that wait in its queues, at most}.
    """

    log: CallbackLog
    messages: Mapping[str, int]
    queue_capacity: Mapping[int, int]


def record(campaign: Campaign, effects: Effects, index: int, path: Path) -> Recorded:
    """Write the replay of the run at a position with these effects, and return what else it left.

    An exception of a protocol ends the run, and is part of the result. What protocols print is discarded.
    """
    log = CallbackLog()
    seen = campaign.record(effects, index, path, log)
    capacities = {
        spec.id: sum(map(_queue_capacity, node_config(spec).wlan))
        for spec in campaign.scenario(effects, index).nodes
    }
    return Recorded(log, seen.messages, capacities)


def _queue_capacity(interface: "InterfaceConfig") -> int:
    return (interface.csma if "802154" in interface.typename else interface.mac).queue_capacity


def record_to_files(campaign: Campaign, effects: Effects, index: int, path: Path, rest: Path) -> None:
    """Write the replay to `path` and what `record` returns to `rest`: processes pass on little."""
    recorded = record(campaign, effects, index, path)
    with rest.open("wb") as file:
        pickle.dump(recorded, file)


def read_recording(path: Path, rest: Path) -> "Recording":
    """Read what `record_to_files` wrote."""
    with rest.open("rb") as file:
        return Recording(read_replay(path), pickle.load(file))


class _Message(NamedTuple):
    cause: Cause
    text: str


@dataclass(frozen=True)
class Recording:
    """A recorded run whose callbacks have causes.

    Attributes:
        replay: The replay.
        recorded: What else the run left.
        frames: Table `frames` of the replay.
        frames_of: {message: rows of its frames, the first transmission and its retries}.
        dropped: {message that has no frame: why}. Messages that wait at the end of the run are not there.
    """

    replay: Replay
    recorded: Recorded
    frames: Mapping[str, Any] = field(init=False)
    frames_of: dict[Cause, list[int]] = field(init=False, default_factory=dict)
    dropped: dict[Cause, str] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "frames", self.replay.table("frames"))
        self._find_messages()

    @property
    def callbacks(self) -> Sequence[Callback]:
        """The callbacks of all nodes, in the order of their calls."""
        return self.recorded.log.callbacks

    @cached_property
    def end_ns(self) -> int:
        """End of the record."""
        return round(self.replay.end_s * 1e9)

    @cached_property
    def outcomes(self) -> Mapping[tuple[int, int], str]:
        """{(frame, receiver): outcome}."""
        return {(frame, receiver): outcome for frame, receiver, outcome in self.replay.receptions()}

    def time_ns(self, message: Cause) -> int:
        """Return when a protocol sent a message; for native protocols, the start of its first frame."""
        if message.callback < 0:
            time_ns: int = self.frames["time_ns"][self.frames_of[message][0]]
            return time_ns
        return self.callbacks[message.callback].time_ns

    def count(self, message: Cause) -> int:
        """Return how many messages the same callback sent to the same destination."""
        if message.callback < 0:
            return int(message in self.frames_of)
        effects = self.callbacks[message.callback].effects
        return sum(each.action == "send" and each.what == message.kind for each in effects)

    def outcome(self, message: Cause, receiver: int) -> str:
        """Return what happens to a message at a receiver: the outcome of its frame, or why it has none.

        "" if it arrives or is in the air at the end of the run, and if there is no such message.
        """
        if message.callback >= 0 and message.number >= self.count(message):
            return ""
        if message in self.dropped:
            return self.dropped[message]
        rows = self.frames_of.get(message)
        if rows is None:
            return "queued" if message.callback >= 0 else ""
        outcomes = [self.outcomes.get((row, receiver), "below_sensitivity") for row in rows]
        end_ns = self.frames["time_ns"][rows[-1]] + self.frames["duration_ns"][rows[-1]]
        if "delivered" in outcomes or "in_air" in outcomes or end_ns + _LONGEST_WAY_NS > self.end_ns:
            return ""
        return outcomes[0]

    def _find_frames(self, texts: Mapping[int, str]) -> None:
        """Find the frames of each message.

        Interfaces send messages in order, unless their queue is full or the channel is busy for too long. The
        text of a frame that arrived somewhere shows which message it has.
        """
        messages = self._messages()
        native = {node["id"] for node in self.replay.run["nodes"]} - {each.node for each in self.callbacks}
        counts: Counter[tuple[int, str]] = Counter()
        waiting: defaultdict[int, deque[_Message]] = defaultdict(deque)
        columns = [self.frames[column] for column in ("time_ns", "node", "destination", "cause")]
        for rows in self._exchanges():
            time_ns, node, destination, name = (column[rows[0]] for column in columns)
            message: Cause | None = Cause(~node, name, counts[node, name])
            if node in native:
                counts[node, name] += 1
            else:
                self._enqueue(messages[node], waiting[node], time_ns)
                text = next((texts[row] for row in rows if row in texts), None)
                message = self._dequeue(waiting[node], destination, name, text)
            if message is not None:
                self.frames_of[message] = rows

    def _exchanges(self) -> Iterator[list[int]]:
        """Yield the rows of each data frame and of its retries, in the order of the first ones."""
        found: list[list[int]] = []
        last: dict[tuple[int, int], list[int]] = {}
        columns = ("node", "destination", "kind", "retry")
        rows = zip(*(self.frames[column] for column in columns), strict=True)
        for row, (node, destination, kind, retry) in enumerate(rows):
            if kind not in DATA_KINDS:
                continue
            if retry and (node, destination) in last:
                last[node, destination].append(row)
            else:
                last[node, destination] = [row]
                found.append(last[node, destination])
        yield from found

    def _enqueue(self, messages: "deque[_Message]", queue: "deque[_Message]", time_ns: int) -> None:
        """Move the messages that were sent until then to the queue of their node."""
        has_limit = self.recorded.messages.get("queue_overflow", 0) > 0
        while messages and self.time_ns(messages[0].cause) <= time_ns + 1:  # times are rounded
            message = messages.popleft()
            if has_limit and len(queue) >= self.recorded.queue_capacity[self._node(message)]:
                self.dropped[message.cause] = "queue_overflow"
            else:
                queue.append(message)

    def _dequeue(
        self, queue: "deque[_Message]", destination: int, name: str, text: str | None
    ) -> Cause | None:
        """Remove the first message that a frame may have, and return it."""
        passed: list[_Message] = []
        for message in queue:
            if message.cause.kind == destination and name in ("", self._name(message)):
                if text is None or text == message.text:
                    break
                passed.append(message)
        else:
            return None
        queue.remove(message)
        if self.recorded.messages.get("channel_access_failure", 0):
            for each in passed:
                queue.remove(each)
                self.dropped[each.cause] = "channel_access_failure"
        return message.cause

    def _name(self, message: "_Message") -> str:
        return self.callbacks[message.cause.callback].name

    def _node(self, message: "_Message") -> int:
        return self.callbacks[message.cause.callback].node

    def _messages(self) -> "defaultdict[int, deque[_Message]]":
        """Return {node: messages in the order in which it sent them}."""
        found: defaultdict[int, deque[_Message]] = defaultdict(deque)
        for index, callback in enumerate(self.callbacks):
            numbers: Counter[str | int] = Counter()
            for effect in callback.effects:
                if effect.action == "send":
                    cause = Cause(index, effect.what, numbers[effect.what])
                    found[callback.node].append(_Message(cause, str(effect.value)))
                    numbers[effect.what] += 1
        return found

    def _arrivals(self) -> Iterator[tuple[Callback, Sequence[int]]]:
        """Yield each `handle_packet` with the frames that ended at its node then."""
        ends: defaultdict[int, list[tuple[int, int]]] = defaultdict(list)
        for frame, receiver, outcome in zip(*self.replay.table("receptions").values(), strict=True):
            is_for = self.frames["destination"][frame] in (BROADCAST, receiver)
            if outcome == _DELIVERED and is_for and self.frames["kind"][frame] in DATA_KINDS:
                end_ns = self.frames["time_ns"][frame] + self.frames["duration_ns"][frame]
                ends[receiver].append((end_ns, frame))
        for each in ends.values():
            each.sort()
        for callback in self.callbacks:
            if callback.name == "packet":
                at = ends[callback.node]
                first = bisect_left(at, (callback.time_ns - _LONGEST_WAY_NS, 0))
                last = bisect_left(at, (callback.time_ns + 2, 0))  # times are rounded
                yield callback, [frame for _, frame in at[first:last]]

    def _find_messages(self) -> None:
        """Find the message and the frame of each `handle_packet`."""
        arrivals = list(self._arrivals())
        self._find_frames({frames[0]: each.argument for each, frames in arrivals if len(frames) == 1})
        message_in = {row: message for message, rows in self.frames_of.items() for row in rows}
        texts = {each.cause: each.text for messages in self._messages().values() for each in messages}
        taken: set[tuple[int, int]] = set()
        for callback, frames in arrivals:
            for frame in frames:
                message = message_in.get(frame)
                is_right = message is None or texts.get(message, callback.argument) == callback.argument
                if is_right and (callback.node, frame) not in taken:
                    taken.add((callback.node, frame))
                    callback.cause, callback.frame = message, frame
                    break
