"""Verdicts on small networks whose clashes have a known cause."""

from collections.abc import Callable

from gradysim.ladder.clashes import Diagnosis, Origin, Pattern, merged

HIDDEN = "*.nodes[*].mobility.lineStepX=70m"
"""Nodes 0 and 2 are 140 m apart and do not hear each other. Node 1 hears both."""

MIDDLE_LISTENS = "*.nodes[1].protocol.sends=false"


def verdicts(diagnosis: Diagnosis) -> list[str]:
    return [pattern.verdict for pattern in diagnosis.patterns]


def test_timers_that_fire_together_are_synchronized(diagnosis_of: Callable[..., Diagnosis]) -> None:
    diagnosis = diagnosis_of()
    (pattern,) = diagnosis.patterns
    assert [str(origin) for origin in pattern.origins] == ['timer "beacon" of nodes[*]']
    assert pattern.verdict == "synchronized"
    assert pattern.apart_s == 0
    assert abs(pattern.period_s - 0.1) < 1e-9
    assert diagnosis.clashes == diagnosis.receptions > 0
    assert 60e-6 < diagnosis.airtime_s < 80e-6


def test_timers_of_hidden_nodes_at_random_times(diagnosis_of: Callable[..., Diagnosis]) -> None:
    busy = "**.protocol.interval=0.002", "**.protocol.spread=0.002", "**.protocol.size=400"
    diagnosis = diagnosis_of(HIDDEN, MIDDLE_LISTENS, *busy)
    assert verdicts(diagnosis) == ["hidden"]
    assert 0.05 < diagnosis.clashes / diagnosis.receptions < 0.5
    assert diagnosis.busiest < 0.5


def test_timers_of_hidden_nodes_in_lock_step(diagnosis_of: Callable[..., Diagnosis]) -> None:
    """Their frames are short, so random times would help although the nodes do not hear each other."""
    assert verdicts(diagnosis_of(HIDDEN, MIDDLE_LISTENS)) == ["synchronized"]


def test_timers_with_a_constant_offset_below_the_airtime(diagnosis_of: Callable[..., Diagnosis]) -> None:
    diagnosis = diagnosis_of(HIDDEN, MIDDLE_LISTENS, "**.protocol.step=0.0001", "**.protocol.size=1000")
    (pattern,) = diagnosis.patterns
    assert pattern.verdict == "synchronized"
    assert abs(pattern.apart_s - 200e-6) < 1e-9


def test_timers_of_hidden_nodes_with_different_periods_drift(diagnosis_of: Callable[..., Diagnosis]) -> None:
    periods = "*.nodes[0].protocol.interval=0.02", "*.nodes[2].protocol.interval=0.02002"
    long = "**.protocol.size=1000"
    assert verdicts(diagnosis_of(HIDDEN, MIDDLE_LISTENS, long, *periods, "sim-time-limit=30s")) == [
        "hidden and drifting"
    ]


def test_more_than_the_channel_carries(diagnosis_of: Callable[..., Diagnosis]) -> None:
    greedy = "**.protocol.interval=0.0004", "**.protocol.spread=0.0004", "**.protocol.size=1000"
    diagnosis = diagnosis_of("sim-time-limit=1.2s", "**.protocol.first=0", *greedy)
    assert set(verdicts(diagnosis)) == {"saturated"}
    assert diagnosis.busiest > 0.7


def test_nodes_that_hear_each_other_at_random_times(diagnosis_of: Callable[..., Diagnosis]) -> None:
    """After a frame, those that waited for its end may choose the same slot."""
    busy = "**.protocol.interval=0.02", "**.protocol.spread=0.02", "**.protocol.size=400", "*.numNodes=20"
    diagnosis = diagnosis_of(*busy, "*.nodes[*].mobility.lineStepX=1m", "sim-time-limit=3s")
    assert verdicts(diagnosis) == ["random"]
    assert diagnosis.busiest < 0.7


def test_answers_to_the_same_message_are_synchronized(diagnosis_of: Callable[..., Diagnosis]) -> None:
    poll = "*.numNodes=20", "*.nodes[0].protocol.sends=true", "*.nodes[*].protocol.sends=false"
    diagnosis = diagnosis_of(*poll, "*.nodes[*].protocol.answers=true", "*.nodes[*].mobility.lineStepX=1m")
    (pattern,) = diagnosis.patterns
    assert [str(origin) for origin in pattern.origins] == ["handle_packet of nodes[*]"]
    assert pattern.verdict == "synchronized"


def test_timers_that_differ_in_numbers_are_one(diagnosis_of: Callable[..., Diagnosis]) -> None:
    (pattern,) = diagnosis_of("**.protocol.timer=beat-#").patterns
    assert [str(origin) for origin in pattern.origins] == ['timer "beat-#" of nodes[*]']
    assert pattern.verdict == "synchronized"
    assert abs(pattern.period_s - 0.1) < 1e-9


def test_frames_in_the_air_at_the_end_are_not_received(diagnosis_of: Callable[..., Diagnosis]) -> None:
    """The second beacons start when the run ends."""
    assert diagnosis_of("**.protocol.step=0.01", "sim-time-limit=1.1s").receptions == 3 * 2


ONE, OTHER = Origin("nodes[*]", "timer one"), Origin("base", "timer other")


def test_patterns_of_several_runs_are_merged() -> None:
    """A pattern has the verdict of most clashes, and the times of the run with most of them."""
    runs = [
        Diagnosis(10, 2, 0.1, (Pattern((ONE,), 2, "random", 1, 0.3),), 0.001),
        Diagnosis(20, 0, 0.3, (), 0),
        Diagnosis(
            30,
            5,
            0.2,
            (Pattern((ONE,), 4, "synchronized", 2, 0.1), Pattern((ONE, OTHER), 1, "hidden", 3, 0.2)),
            0.003,
        ),
        Diagnosis(40, 1, 0.2, (Pattern((ONE,), 1, "synchronized", 4, 0.4),), 0.002),
    ]
    assert merged(runs) == Diagnosis(
        100,
        8,
        0.3,
        (Pattern((ONE,), 7, "synchronized", 2, 0.1), Pattern((ONE, OTHER), 1, "hidden", 3, 0.2)),
        0.002,
    )


def test_no_runs_have_no_clashes() -> None:
    assert merged([]) == Diagnosis(0, 0, 0, (), 0)


def test_no_clashes(diagnosis_of: Callable[..., Diagnosis]) -> None:
    diagnosis = diagnosis_of("**.protocol.step=0.01")
    assert diagnosis.patterns == ()
    assert (diagnosis.clashes, diagnosis.airtime_s) == (0, 0)
    assert diagnosis.receptions > 0
