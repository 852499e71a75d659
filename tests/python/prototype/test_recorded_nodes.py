import pytest

from gradysim.prototype.run import run
from python.recorded_protocols import COUNTER, EARLY, FLYING, vectors_of


def test_each_assignment_with_its_time(make_scenario):
    count = vectors_of(run(make_scenario(COUNTER), vectors_of=[0]))["count"]
    assert list(count.times_ps)[:4] == [0, 70_000_000_000, 770_000_000_000, 1_470_000_000_000]
    assert list(count.values)[:4] == [0, 1, 2, 3]


def test_another_dictionary_ends_what_was_tracked(make_scenario):
    vectors = vectors_of(run(make_scenario(COUNTER), vectors_of=[0]))
    assert str(vectors["count"].values[-1]) == "nan"
    assert (list(vectors["finished"].times_ps), list(vectors["finished"].values)) == (
        [2_050_000_000_000],
        [1],
    )


def test_the_place_at_each_telemetry(make_scenario):
    vectors = vectors_of(run(make_scenario(FLYING), vectors_of=[0]))
    assert list(vectors["positionZ"].times_ps) == [500_000_000_000 * number for number in (1, 2, 3, 4)]
    assert [round(height, 6) for height in vectors["positionZ"].values] == [5, 10, 15, 20]
    assert set(vectors["positionX"].values) == {0}


def test_variables_that_the_protocol_took_when_it_was_made(make_scenario):
    result = run(make_scenario(EARLY), vectors_of=[0])
    vectors = vectors_of(result)
    assert (list(vectors["made"].times_ps), list(vectors["made"].values)) == ([0], [1])
    assert list(vectors["begun"].values) == [2, 3, 4, 5, 6]
    assert result.nodes[0].tracked_variables == {"made": 1, "begun": 6}


@pytest.mark.parametrize("python", ["class Tested(Talker): pass", EARLY], ids=["late", "early"])
def test_the_run_is_the_same(make_scenario, python):
    asked, unasked = (run(make_scenario(python), vectors_of=ids) for ids in ([0, 1], []))
    assert (asked.fates, asked.events) == (unasked.fates, unasked.events)
    assert [node.tracked_variables for node in asked.nodes] == [
        node.tracked_variables for node in unasked.nodes
    ]
