"""The sentences about timers that clash."""

from dataclasses import replace

import pytest

from gradysim.ladder.clashes import Diagnosis, Origin, Pattern
from gradysim.ladder.desync import Desync, Trial
from gradysim.ladder.desync_words import desync_sentences, text_of_time
from gradysim.ladder.failure import Failure

PATTERN = Pattern((Origin("uavs[*]", "timer heartbeat"),), 40, "synchronized", 1, 0)
DIAGNOSIS = Diagnosis(100, 40, 0.1, (PATTERN,), 0.001)
FOUND = Desync(
    DIAGNOSIS,
    (("uavs[*]", "heartbeat"),),
    (Trial(0, 0.55, 0.4, "interference"), Trial(0.01, 0.8, 0.15, "noise"), Trial(0.02, 0.79, 0.16, "noise")),
    0.01,
    runs_per_trial=4,
)
FAILURE = Failure("KeyError", "'1'", "in handle_packet of node 0 (Base 0) at 2 s of simulated time")


def test_a_recommendation_says_what_remains_lost() -> None:
    assert list(desync_sentences(FOUND)) == [
        "40 of 100 receptions in 4 runs were lost to another frame (40.0%).",
        '  100% of them: timer "heartbeat" of uavs[*]: fire together, 0 s apart, every 1 s',
        'Delay timer "heartbeat" of uavs[*] by a random time of up to 10 ms: 55.0% of the receptions arrive'
        " without it, 80.0% with it, and 80.0% at best (16 runs).",
        "Even then, 20.0% are lost, most of them to `noise`.",
    ]


def test_a_jitter_that_saves_little_does_not_help() -> None:
    assert list(desync_sentences(replace(FOUND, jitter_s=0)))[-1] == (
        'A random delay of timer "heartbeat" of uavs[*] does not help: 40.0% of the receptions are lost to'
        " other frames without it, and still 15.0% with the best one (16 runs)."
    )


def test_no_clashes() -> None:
    (text,) = desync_sentences(Desync(Diagnosis(20, 0, 0.1, (), 0), runs_per_trial=1))
    assert text == "None of 20 receptions in 1 run was lost to another frame."


@pytest.mark.parametrize(
    ("failed", "expected"),
    [
        ([2], [f"Run 2 failed: {FAILURE}."]),
        (range(4), ["All 4 runs failed. What is said below is about the time before."]),
    ],
)
def test_runs_that_failed_come_first(failed: list[int], expected: list[str]) -> None:
    found = replace(FOUND, failures=dict.fromkeys(failed, FAILURE))
    assert list(desync_sentences(found))[: len(expected)] == expected
    assert list(desync_sentences(found))[-1] == f"With it, 0 of 4 runs fail; without it, {len(failed)}."


def test_the_most_failures_that_are_named() -> None:
    found = replace(FOUND, runs_per_trial=9, failures=dict.fromkeys(range(8), FAILURE))
    lines = list(desync_sentences(found))
    assert [line[:12] for line in lines[:3]] == ["Run 0 failed", "Run 1 failed", "Run 2 failed"]
    assert lines[3] == "So did 5 other runs."


def test_a_failure_with_jitter_alone_is_named() -> None:
    failing = replace(FOUND.trials[1], failures={3: FAILURE})
    found = replace(FOUND, trials=(FOUND.trials[0], failing, FOUND.trials[2]))
    assert list(desync_sentences(found))[-1] == f"With a jitter of up to 10 ms, run 3 fails: {FAILURE}."


@pytest.mark.parametrize(
    ("seconds", "expected"),
    [(2.5, "2.5 s"), (0.99996, "1 s"), (0.0123, "12.3 ms"), (54.1e-6, "54.1 µs"), (3e-9, "3 ns"), (0, "0 s")],
)
def test_a_time_has_three_digits(seconds: float, expected: str) -> None:
    assert text_of_time(seconds) == expected
