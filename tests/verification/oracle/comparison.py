"""Comparison of the engine and the oracle, frame by frame."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import zip_longest
from math import log10

from verification.oracle.access import differences_in_access
from verification.oracle.captured_frame import CapturedFrame
from verification.oracle.case import Case
from verification.oracle.engine_run import EngineRun
from verification.oracle.prediction import Prediction, predict
from verification.oracle.radio import Reception

HALF_DBM = 0.5 + 1e-9
"""Captures round powers to whole dBm."""


@dataclass(frozen=True)
class Comparison:
    """One case.

    Attributes:
        differences: One line for each difference; empty if the two agree.
        outcomes: Compared arrivals: those strong enough to be received.
        receptions: Compared frames to which a radio was locked until the end.
        uncertain: Receptions decided by the random number.
        radios: Radios compared.
        left_out: Radios without a comparison, since captures do not determine the order of events there.
    """

    differences: list[str]
    outcomes: int
    receptions: int
    uncertain: int
    radios: int
    left_out: int


def compare(case: Case, run: EngineRun) -> Comparison:
    """Compare the prediction of the oracle with the run."""
    prediction = predict(case, run)
    chosen = [index for index, certain in enumerate(prediction.certain) if certain]
    differences = [line for index in chosen for line in _differences_at(index, run, prediction)]
    for index in chosen:
        differences += differences_in_access(case, index, run.sent[index], prediction.heard[index])
    if len(chosen) == len(case.stations) and prediction.below_sensitivity != run.below_sensitivity:
        differences.append(
            f"below sensitivity: {run.below_sensitivity}, expected {prediction.below_sensitivity}"
        )
    heard = [prediction.heard[index] for index in chosen]
    return Comparison(
        differences=[f"case {case.seed}, {line}" for line in differences],
        outcomes=sum(one.outcomes.total() for one in heard),
        receptions=sum(len(one.receptions) for one in heard),
        uncertain=sum(one.uncertain for one in heard),
        radios=len(chosen),
        left_out=len(case.stations) - len(chosen),
    )


def _differences_at(index: int, run: EngineRun, prediction: Prediction) -> list[str]:
    heard, noise_w = prediction.heard[index], prediction.noise_w[index]
    lines = []
    if heard.outcomes != run.outcomes[index]:
        lines.append(
            f"station {index}: outcomes {dict(run.outcomes[index])}, expected {dict(heard.outcomes)}"
        )
    pairs: Sequence[tuple[CapturedFrame | None, Reception | None]] = list(
        zip_longest(run.received[index], heard.receptions)
    )
    for number, (captured, expected) in enumerate(pairs):
        if captured is None or expected is None or not _is_same(captured, expected, noise_w):
            lines.append(
                f"station {index}, reception {number}: {_told(captured)}, expected {_expected(expected)}"
            )
    return lines


def _is_same(captured: CapturedFrame, expected: Reception, noise_w: float) -> bool:
    arrival = expected.arrival
    late_ps = captured.time_ns * 1000 - arrival.start_ps
    return (
        -1000 < late_ps <= arrival.sent.slack_ps
        and captured.octets == arrival.sent.octets
        and captured.decoded is expected.decoded
        and _is_rounded(captured.signal_dbm, arrival.power_w)
        and _is_rounded(captured.noise_dbm, noise_w)
    )


def _is_rounded(captured_dbm: int | None, power_w: float) -> bool:
    dbm = min(max(10 * log10(power_w) + 30, -128.0), 127.0)
    return captured_dbm is not None and abs(captured_dbm - dbm) <= HALF_DBM


def _told(captured: CapturedFrame | None) -> str:
    if captured is None:
        return "none"
    return f"{captured.time_ns} ns, {captured.signal_dbm} dBm, decoded: {captured.decoded}"


def _expected(reception: Reception | None) -> str:
    if reception is None:
        return "none"
    arrival = reception.arrival
    dbm = 10 * log10(arrival.power_w) + 30
    return f"{arrival.start_ps} ps from {arrival.sent.sender}, {dbm} dBm, decoded: {reception.decoded}"
