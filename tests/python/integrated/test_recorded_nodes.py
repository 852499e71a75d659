import pytest

import gradysim.prototype.run
from gradysim.integrated.run import IntegratedRun, run
from python.recorded_protocols import COUNTER, FLYING, vectors_of

EARLY = """
class Tested(Quiet):
    @classmethod
    def instantiate(cls, provider):
        protocol = super().instantiate(provider)
        protocol.tracked = provider.tracked_variables
        protocol.tracked["made"] = 1
        return protocol
    def initialize(self):
        self.tracked["begun"] = 2
    def handle_telemetry(self, telemetry):
        self.tracked["begun"] += 1
"""

REBOUND = """
class Tested(Quiet):
    def initialize(self):
        self.handle_telemetry = lambda telemetry: None
"""

BEACON = '*.uavs[*].protocol.typename = "BeaconProtocol"'

ONCE = """
class Tested(Quiet):
    at: float = 0
    def initialize(self):
        if self.provider.get_id() == 0:
            self.provider.schedule_timer("talk", self.at)
    def handle_timer(self, timer):
        self.provider.send_communication_command(BroadcastMessageCommand("hello"))
    def handle_packet(self, message):
        self.provider.tracked_variables["heard"] = 1
"""


def test_a_run_records_nothing_unasked(make_scenario):
    assert [node.vectors for node in run(make_scenario()).nodes] == [None, None]


def test_it_records_the_nodes_that_it_is_asked_for(make_scenario):
    nodes = run(make_scenario(), vectors_of=[1]).nodes
    assert [node.vectors is not None for node in nodes] == [False, True]


@pytest.mark.parametrize("python", [COUNTER, FLYING, EARLY], ids=["tracked", "flying", "early"])
def test_it_is_what_prototype_mode_records(make_scenario, python):
    scenario = make_scenario(python)
    ours = vectors_of(run(scenario, vectors_of=[0]))
    theirs = vectors_of(gradysim.prototype.run.run(scenario, vectors_of=[0]))
    assert ours.keys() == theirs.keys()
    for name, vector in ours.items():
        assert vector.times_ps == theirs[name].times_ps
        assert list(vector.values) == pytest.approx(list(theirs[name].values), nan_ok=True)


def test_telemetry_is_recorded_whatever_a_plugin_binds_to_its_callback(make_scenario):
    vectors = vectors_of(run(make_scenario(REBOUND), vectors_of=[0]))
    assert len(vectors["positionX"].values) == 4


def test_what_a_native_protocol_tracks(make_scenario):
    scenario = make_scenario("class Tested(Quiet): pass", BEACON, "*.uavs[*].protocol.spread = 100ms")
    result = run(scenario, vectors_of=[0, 1])
    for node in result.nodes:
        vectors = {vector.name: vector for vector in node.vectors}
        assert vectors["sent"].values[-1] == node.tracked_variables["sent"] > 0
        assert len(vectors["positionX"].values) == 4


def test_times_are_exact_when_floats_no_longer_are(make_scenario):
    def delay_ps(at_s):
        limits = "sim-time-limit = 9000000s", "*.uavs[*].mobility.telemetryInterval = 0s"
        scenario = make_scenario(ONCE, *limits, f"**.at = {at_s}s")
        (time_ps,) = vectors_of(run(scenario, vectors_of=[1]), 1)["heard"].times_ps
        return time_ps - at_s * 10**12

    assert delay_ps(8_000_000) == delay_ps(1) > 0


def test_the_run_is_the_same(make_scenario):
    asked, unasked = (run(make_scenario(), vectors_of=ids) for ids in ([0, 1], []))
    assert (asked.fingerprint, asked.events) == (unasked.fingerprint, unasked.events)


def test_a_view_of_what_was_recorded_does_not_end_the_run(make_scenario):
    views = []

    def look():
        views.extend(memoryview(vector.values) for vector in watched.result().nodes[0].vectors)
        return False

    scenario = make_scenario(FLYING, "*.uavs[*].mobility.telemetryInterval = 10ms")
    watched = IntegratedRun(scenario, vectors_of=[0])
    watched.execute(should_stop=look)
    assert views
    assert vectors_of(watched.result()) == vectors_of(run(scenario, vectors_of=[0]))


def test_a_run_that_was_stopped_has_what_has_been(make_scenario):
    stopped = IntegratedRun(make_scenario(COUNTER), vectors_of=[0])
    stopped.execute(should_stop=lambda: True)
    assert vectors_of(stopped.result())["count"].values[0] == 0


def test_an_id_that_is_not_there_is_refused_before_the_run(make_scenario):
    with pytest.raises(ValueError, match=r"^vectors_of: there is no node 2; expected ids of the 2 nodes"):
        IntegratedRun(make_scenario(), vectors_of=[2])
