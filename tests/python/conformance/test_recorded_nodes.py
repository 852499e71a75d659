"""Vectors of nodes are the same in both modes."""

import pytest

from gradysim.integrated.run import IntegratedRun
from gradysim.prototype.run import PrototypeRun
from python.recorded_protocols import COUNTER, EARLY, FLYING, vectors_of

MODES = {"integrated": IntegratedRun, "prototype": PrototypeRun}


@pytest.fixture(params=MODES)
def new_run(request):
    """Return a function that makes a run of a scenario, in one of the modes, without executing it."""
    return MODES[request.param]


def executed(run, **options):
    run.execute(**options)
    return run.result()


def test_a_run_records_nothing_unasked(new_run, make_scenario):
    assert [node.vectors for node in executed(new_run(make_scenario())).nodes] == [None, None]


def test_it_records_the_nodes_that_it_is_asked_for(new_run, make_scenario):
    nodes = executed(new_run(make_scenario(), vectors_of=[1])).nodes
    assert [node.vectors is not None for node in nodes] == [False, True]


def test_an_id_that_is_not_there_is_refused_before_the_run(new_run, make_scenario):
    with pytest.raises(ValueError, match=r"^vectors_of: .* node 2; "):
        new_run(make_scenario(), vectors_of=[2])


@pytest.mark.parametrize("python", [COUNTER, FLYING, EARLY], ids=["tracked", "flying", "early"])
def test_both_modes_record_the_same(make_scenario, python):
    scenario = make_scenario(python)
    one, other = (vectors_of(executed(new_run(scenario, vectors_of=[0]))) for new_run in MODES.values())
    assert one.keys() == other.keys()
    for name, vector in one.items():
        assert vector.times_ps == other[name].times_ps
        assert list(vector.values) == pytest.approx(list(other[name].values), nan_ok=True)


def test_a_view_of_what_was_recorded_does_not_end_the_run(new_run, make_scenario):
    views = []

    def look():
        views.extend(memoryview(vector.values) for vector in watched.result().nodes[0].vectors)
        return False

    scenario = make_scenario(FLYING, "*.uavs[*].mobility.telemetryInterval = 10ms")
    watched = new_run(scenario, vectors_of=[0])
    result = executed(watched, should_stop=look)
    assert views
    assert vectors_of(result) == vectors_of(executed(new_run(scenario, vectors_of=[0])))


def test_a_run_that_was_stopped_has_what_has_been(new_run, make_scenario):
    stopped = executed(new_run(make_scenario(COUNTER), vectors_of=[0]), should_stop=lambda: True)
    assert vectors_of(stopped)["count"].values[0] == 0
