from typing import Any

from gradysim.results.outcomes import outcome_ratios


def ratios(outcomes: dict[str, Any]) -> dict[str, float]:
    return {average.name: average.value for average in outcome_ratios(outcomes)}


def test_messages_to_one_node_by_their_outcomes() -> None:
    unicast = {"sent": 0, "acknowledged": 6, "retry_limit": 3, "queue_overflow": 1, "queued": 10}
    assert ratios({"frames": {}, "messages": {"unicast": unicast}}) == {
        "unicast messages sent": 0,
        "unicast messages acknowledged": 0.6,
        "unicast messages retry limit": 0.3,
        "unicast messages queue overflow": 0.1,
    }


def test_of_broadcasts_what_kept_them_from_the_air() -> None:
    broadcast = {"sent": 3, "acknowledged": 0, "queue_overflow": 1, "queued": 9}
    assert ratios({"messages": {"broadcast": broadcast}}) == {"broadcast messages queue overflow": 0.25}


def test_of_frames_those_that_arrived() -> None:
    broadcast = {"delivered": 6, "interference": 2, "in_air": 12}
    assert ratios({"frames": {"broadcast": broadcast}}) == {"broadcast frames delivered": 0.75}


def test_frames_that_were_overheard_do_not_count() -> None:
    frames = {"ack": {"delivered": 1}, "ack overheard": {"delivered": 5}}
    assert ratios({"frames": frames}) == {"ack frames delivered": 1}


def test_of_what_nothing_was_decided_there_is_no_share() -> None:
    outcomes = {"frames": {"unicast": {"delivered": 0, "in_air": 2}}, "messages": {"unicast": {"queued": 2}}}
    assert ratios(outcomes) == {}
