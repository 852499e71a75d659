"""Why a level breaks a protocol: what differs between two runs of the same seed."""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from gradysim.ladder.clashes import Diagnosis, diagnose
from gradysim.replay.reader import Replay
from gradysim.replay.tables import BROADCAST, FRAME_KINDS, NOT_LOST

_NS_PER_S = 1e9
_DATA = {FRAME_KINDS.index("broadcast"), FRAME_KINDS.index("unicast")}


@dataclass(frozen=True)
class Difference:
    """The first reception that ends differently.

    Attributes:
        time_s: Start of the frame at the level that fails.
        sender: Name of the node.
        receiver: Name of the node.
        cause: The callback that sent it, such as `timer heartbeat`.
        before: Outcome at the level that works; "" if there is no such reception.
        after: Outcome at the level that fails; likewise.
    """

    time_s: float
    sender: str
    receiver: str
    cause: str
    before: str
    after: str


@dataclass(frozen=True)
class Explanation:
    """What differs between a run that works and one that fails.

    Attributes:
        losses: {outcome: (ratio where it works, ratio where it fails)} of the receptions at the addressees of
            messages; the largest increase first.
        first: The first reception that ends differently; None if all end alike.
        diagnosis: The clashes where it fails.
    """

    losses: Mapping[str, tuple[float, float]]
    first: Difference | None
    diagnosis: Diagnosis


def explain(works: Replay, fails: Replay) -> Explanation:
    """Compare two recorded runs of the same scenario and seed, with different effects."""
    before, after = _ratios(works), _ratios(fails)
    losses = {name: (before.get(name, 0.0), after.get(name, 0.0)) for name in sorted({*before, *after})}
    by_increase = dict(sorted(losses.items(), key=lambda item: item[1][0] - item[1][1]))
    return Explanation(by_increase, _first_difference(works, fails), diagnose(fails))


def _ratios(replay: Replay) -> Mapping[str, float]:
    """Return the ratio of each outcome of losses among the receptions at addressees of messages."""
    counts: Counter[str] = Counter(outcome for *_, outcome in _receptions(replay))
    total = sum(counts.values())
    return {outcome: count / total for outcome, count in counts.items() if outcome not in NOT_LOST}


def _receptions(replay: Replay) -> Iterator[tuple[int, int, str]]:
    """Yield (frame, receiver, outcome) of the receptions of messages at their addressees."""
    frames: Any = replay.table("frames")
    for frame, receiver, outcome in replay.receptions():
        if frames["kind"][frame] in _DATA and frames["destination"][frame] in (BROADCAST, receiver):
            yield frame, receiver, outcome


def _first_difference(works: Replay, fails: Replay) -> Difference | None:
    """Compare frames by sender and their number among the frames of the sender."""
    tables: list[Any] = [each.table("frames") for each in (works, fails)]
    outcomes = [_by_number(each, table) for each, table in zip((works, fails), tables, strict=True)]
    names = {node["id"]: node["name"] for node in fails.run["nodes"]}
    found: list[tuple[int, Difference]] = []
    for key in outcomes[0].keys() | outcomes[1].keys():
        (frame, before), (other, after) = (each.get(key, (None, "")) for each in outcomes)
        if before != after:
            table, row = (tables[0], frame) if other is None else (tables[1], other)
            time_ns = table["time_ns"][row]
            sender, receiver, _ = key
            cause = table["cause"][row]
            found.append(
                (
                    time_ns,
                    Difference(time_ns / _NS_PER_S, names[sender], names[receiver], cause, before, after),
                )
            )
    return min(found, key=lambda each: (each[0], each[1].receiver))[1] if found else None


def _by_number(replay: Replay, frames: Any) -> dict[tuple[int, int, int], tuple[int, str]]:
    """Return {(sender, receiver, number of the frame among the sender's): (frame, outcome)}."""
    sent: Counter[int] = Counter()
    numbers = []
    for sender, kind in zip(frames["node"], frames["kind"], strict=True):
        numbers.append(sent[sender])
        sent[sender] += kind in _DATA
    return {
        (frames["node"][frame], receiver, numbers[frame]): (frame, outcome)
        for frame, receiver, outcome in _receptions(replay)
        if outcome != "in_air"
    }
