"""Why a level breaks a protocol: what differs between two runs of the same seed."""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from gradysim.ladder.campaign import LOST_MESSAGES
from gradysim.ladder.clashes import Diagnosis, diagnose
from gradysim.replay.reader import Replay
from gradysim.replay.tables import BROADCAST, FRAME_KINDS, NOT_LOST

_NS_PER_S = 1e9
_TOO_WEAK = "below_sensitivity"
_DATA = {FRAME_KINDS.index("broadcast"), FRAME_KINDS.index("unicast")}


@dataclass(frozen=True)
class Difference:
    """The first reception that ends differently.

    Attributes:
        time_s: Start of the frame at the level that fails.
        sender: Name of the node.
        receiver: Name of the node.
        cause: The callback that sent it, such as `timer heartbeat`.
        before: Outcome at the level that works; "" if the frame was not sent there.
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
            messages; the largest increase first. `below_sensitivity` includes what is out of range.
        messages: The same for messages that their sender gave up.
        first: The first reception that ends differently; None if all end alike.
        diagnosis: The clashes where it fails.
    """

    losses: Mapping[str, tuple[float, float]]
    messages: Mapping[str, tuple[float, float]]
    first: Difference | None
    diagnosis: Diagnosis


def explain(
    works: Replay, fails: Replay, messages: tuple[Mapping[str, int], Mapping[str, int]]
) -> Explanation:
    """Compare two recorded runs of the same scenario and seed, with different effects.

    `messages` are the outcomes of the messages of both, as `Campaign.record` returns them.
    """
    given_up = [
        {name: each.get(name, 0) / max(1, sum(each.values())) for name in LOST_MESSAGES} for each in messages
    ]
    return Explanation(
        _side_by_side(_ratios(works), _ratios(fails)),
        _side_by_side(*given_up),
        _first_difference(works, fails),
        diagnose(fails),
    )


def _side_by_side(
    before: Mapping[str, float], after: Mapping[str, float]
) -> Mapping[str, tuple[float, float]]:
    ratios = {outcome: (before.get(outcome, 0.0), after.get(outcome, 0.0)) for outcome in {*before, *after}}
    return dict(sorted(ratios.items(), key=lambda item: (item[1][0] - item[1][1], item[0])))


def _ratios(replay: Replay) -> Mapping[str, float]:
    """Return the ratio of each outcome of losses among the receptions at addressees of messages.

    Receptions that are too weak count among all, others among those that receivers noticed.
    """
    counts: Counter[str] = Counter(outcome for *_, outcome in _receptions(replay))
    noticed = counts.total()
    frames: Any = replay.table("frames")
    addressees = 0
    for kind, destination, receptions, unnoticed in zip(
        frames["kind"], frames["destination"], frames["receptions"], frames["unnoticed"], strict=True
    ):
        if kind in _DATA:
            addressees += receptions + unnoticed if destination == BROADCAST else 1
    lost = {outcome: count / noticed for outcome, count in counts.items() if outcome not in NOT_LOST}
    return lost | {_TOO_WEAK: 1 - noticed / addressees if addressees else 0.0}


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
    sent = [_sent(table) for table in tables]
    names = {node["id"]: node["name"] for node in fails.run["nodes"]}
    found: list[tuple[int, Difference]] = []
    for key in outcomes[0].keys() | outcomes[1].keys():
        sender, receiver, number = key
        before, after = (
            outcome.get(key, _TOO_WEAK if (sender, number) in frames else "")
            for outcome, frames in zip(outcomes, sent, strict=True)
        )
        if before != after:
            table = 1 if after else 0
            frame = sent[table][sender, number]
            time_ns, cause = tables[table]["time_ns"][frame], tables[table]["cause"][frame]
            difference = Difference(time_ns / _NS_PER_S, names[sender], names[receiver], cause, before, after)
            found.append((time_ns, difference))
    return min(found, key=lambda each: (each[0], each[1].receiver))[1] if found else None


def _by_number(replay: Replay, frames: Any) -> dict[tuple[int, int, int], str]:
    """Return {(sender, receiver, number of the frame among the sender's): outcome}."""
    numbers = {frame: key for key, frame in _sent(frames).items()}
    found = {}
    for frame, receiver, outcome in _receptions(replay):
        if outcome != "in_air":
            sender, number = numbers[frame]
            found[sender, receiver, number] = outcome
    return found


def _sent(frames: Any) -> dict[tuple[int, int], int]:
    """Return {(sender, number of the frame among the sender's): frame} of the frames of messages."""
    count: Counter[int] = Counter()
    found = {}
    for frame, (sender, kind) in enumerate(zip(frames["node"], frames["kind"], strict=True)):
        if kind in _DATA:
            found[sender, count[sender]] = frame
            count[sender] += 1
    return found
