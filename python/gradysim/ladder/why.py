"""Why a level breaks a protocol: what differs between two runs of the same seed."""

from collections import Counter
from collections.abc import Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from gradysim.ladder.campaign import Campaign, Effects, submitted
from gradysim.ladder.clashes import Diagnosis, diagnose
from gradysim.ladder.difference import Difference, first_difference
from gradysim.ladder.observation import LOST_MESSAGES
from gradysim.ladder.recording import Recording, read_recording, record_to_files
from gradysim.replay.reader import Replay
from gradysim.replay.tables import BROADCAST, DATA_KINDS, NOT_LOST

_TOO_WEAK = "below_sensitivity"


@dataclass(frozen=True)
class Explanation:
    """What differs between a run that works and one that fails.

    Attributes:
        losses: {outcome: (ratio where it works, ratio where it fails)} of the receptions at the addressees of
            messages; the largest increase first. `below_sensitivity` includes what is out of range.
        messages: The same for messages that their sender gave up.
        first: The first callback at which the runs part; None if all do the same at the same times.
        diagnosis: The clashes where it fails.
    """

    losses: Mapping[str, tuple[float, float]]
    messages: Mapping[str, tuple[float, float]]
    first: Difference | None
    diagnosis: Diagnosis


def record_and_explain(
    campaign: Campaign,
    effects: tuple[Effects, Effects],
    index: int,
    files: tuple[Path, Path],
    executor: Executor | None = None,
) -> Explanation:
    """Record the run at a position with two sets of effects, and compare the recordings.

    Args:
        campaign: The configuration.
        effects: Those with which it works, and those with which it fails.
        index: Index of the run.
        files: Replays to write.
        executor: Executes the runs, see `Campaign.observations`; None for this process.
    """
    with TemporaryDirectory() as folder:
        rests = [Path(folder, name) for name in ("works", "fails")]
        recorded = [
            submitted(executor, record_to_files, campaign, *arguments)
            for arguments in zip(effects, (index, index), files, rests, strict=True)
        ]
        for each in recorded:
            each.result()
        return explain(*map(read_recording, files, rests))


def explain(works: Recording, fails: Recording) -> Explanation:
    """Compare two recorded runs of the same scenario and seed, with different effects."""
    both = (works, fails)
    given_up = [
        {name: each.get(name, 0) / max(1, sum(each.values())) for name in LOST_MESSAGES}
        for each in (recording.recorded.messages for recording in both)
    ]
    return Explanation(
        _side_by_side(_ratios(works.replay), _ratios(fails.replay)),
        _side_by_side(*given_up),
        first_difference(works, fails),
        diagnose(fails.replay),
    )


def _side_by_side(
    before: Mapping[str, float], after: Mapping[str, float]
) -> Mapping[str, tuple[float, float]]:
    ratios = {outcome: (before.get(outcome, 0.0), after.get(outcome, 0.0)) for outcome in {*before, *after}}
    return dict(sorted(ratios.items(), key=lambda item: (item[1][0] - item[1][1], item[0])))


def _ratios(replay: Replay) -> Mapping[str, float]:
    """Return the ratio of each outcome of losses among the receptions at addressees of messages.

    Receptions that are too weak count among all, others among those that receivers noticed. Frames in the air
    at the end of the run do not count.
    """
    frames: Any = replay.table("frames")
    receptions = [reception for reception in replay.receptions() if reception.outcome != _TOO_WEAK]
    ended = Counter(frame for frame, _, outcome in receptions if outcome != "in_air")
    addressees = 0
    complete = set()
    for frame, kind in enumerate(frames["kind"]):
        noticed, unnoticed = frames["receptions"][frame], frames["unnoticed"][frame]
        if kind in DATA_KINDS and ended[frame] == noticed:
            complete.add(frame)
            addressees += noticed + unnoticed if frames["destination"][frame] == BROADCAST else 1
    counts = Counter(
        outcome
        for frame, receiver, outcome in receptions
        if frame in complete and frames["destination"][frame] in (BROADCAST, receiver)
    )
    noticed = counts.total()
    lost = {outcome: count / noticed for outcome, count in counts.items() if outcome not in NOT_LOST}
    return lost | {_TOO_WEAK: 1 - noticed / addressees if addressees else 0.0}
