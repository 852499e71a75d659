"""The sentences about a first difference."""

import pytest

from gradysim.ladder.callbacks import Effect
from gradysim.ladder.clashes import Diagnosis
from gradysim.ladder.difference import Difference, Event
from gradysim.ladder.explanation_words import explanation_sentences
from gradysim.ladder.why import Explanation

ANSWER = Event("packet", "server", "packet", is_answer=True)
REPORT = Event("packet", "drones[1]", "timer report-#")
LOOK = Event("timer look")


@pytest.mark.parametrize(
    ("first", "expected"),
    [
        (
            Difference("order", 1.000001, "client", ANSWER, LOOK, (-1e-6, 0.00041), is_later=True),
            "First difference, at 1.000001 s at client: the answer of server comes 410 µs after"
            ' timer "look" at level 2, and 1 µs before it at level 1.',
        ),
        (
            Difference("order", 1, "base", REPORT, LOOK, (0, -0.25)),
            'First difference, at 1.000000 s at base: the message of timer "report-#" from drones[1] comes'
            ' 250 ms before timer "look" at level 2, and right after it at level 1.',
        ),
        (
            Difference("lost", 1, "sink", REPORT, outcomes=("delivered", "queue_overflow"), message=(3, 9)),
            'First difference, at 1.000000 s at sink: message 3 of 9 of timer "report-#" from drones[1] is'
            " delivered at level 1 and lost to `queue overflow` at level 2.",
        ),
        (
            Difference("position", 19, "drone", Event("telemetry"), distance_m=0.7249),
            "First difference, at 19.000000 s at drone: in handle_telemetry, it is 0.725 m away from its"
            " position at level 1.",
        ),
        (
            Difference("reported position", 19, "drone", Event("telemetry"), distance_m=2.3),
            "First difference, at 19.000000 s at drone: handle_telemetry reports a position that is 2.3 m"
            " away from the true one.",
        ),
        (
            Difference("time", 2.5, "drone", REPORT, apart_s=(0, 0.0123)),
            'First difference, at 2.500000 s at drone: the message of timer "report-#" from drones[1] comes'
            " 12.3 ms later at level 2 than at level 1.",
        ),
    ],
)
def test_a_difference_in_words(first: Difference, expected: str) -> None:
    assert list(explanation_sentences(explanation(first), 1, 2)) == [expected]


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        (
            Effect("set", "answered", 4),
            Effect("set", "gave up", 1),
            "sets `gave up` to 1 and does not set `answered`",
        ),
        (Effect("set", "good", 1), Effect("set", "good", 0), "sets `good` to 0 instead of 1"),
        (None, Effect("raise", "KeyError", "'1'"), "raises KeyError: '1'"),
        (Effect("send", 0, "photo"), None, "does not send its message"),
        (None, Effect("attribute", "waits", False), "sets `self.waits` to False"),
        (None, Effect("attribute", "heard", ("set", 3)), "changes `self.heard`"),
        (Effect("cancel", "timeout", None), None, 'does not cancel timer "timeout"'),
        (None, Effect("set", "error", 5.41000690e-05), "sets `error` to 5.41001e-05"),
    ],
)
def test_what_a_callback_does_in_words(before: Effect | None, after: Effect | None, expected: str) -> None:
    effects = tuple(() if each is None else (each,) for each in (before, after))
    first = Difference(
        "position", 1, "drone", LOOK, affected=LOOK, affected_time_s=1.5, effects=(effects[0], effects[1])
    )
    sentence = list(explanation_sentences(explanation(first), 1, 2))[-1]
    assert sentence == f'So timer "look" {expected} at level 2, at 1.500000 s.'


def test_a_callback_that_does_something_else_for_no_known_reason() -> None:
    effects: tuple[tuple[Effect, ...], tuple[Effect, ...]] = ((), (Effect("raise", "KeyError", "'1'"),))
    first = Difference("values", 1, "base", LOOK, affected=LOOK, affected_time_s=1, effects=effects)
    assert list(explanation_sentences(explanation(first), 1, 2)) == [
        "First difference, at 1.000000 s at base: timer \"look\" raises KeyError: '1' at level 2,"
        " after calls in the same order, at the same time and position."
    ]


def explanation(first: Difference) -> Explanation:
    return Explanation({}, {}, first, Diagnosis(0, 0, 0, (), 0))
