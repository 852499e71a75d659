from gradysim.integrated.run import run
from python.recorded_protocols import vectors_of

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


def test_telemetry_is_recorded_whatever_a_plugin_binds_to_its_callback(make_scenario):
    vectors = vectors_of(run(make_scenario(REBOUND), vectors_of=[0]))
    assert list(vectors["positionX"].times_ps) == [500_000_000_000, 2_000_000_000_000]


def test_the_interval_of_the_scenario_holds(make_scenario):
    flying = """
class Tested(Quiet):
    def initialize(self):
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(0, 0, 100))
"""
    settings = ("vector-record-interval = 1s", "*.uavs[*].mobility.telemetryInterval = 10ms")
    vectors = vectors_of(run(make_scenario(flying, *settings), vectors_of=[0]))
    times_s = [time_ps / 1e12 for time_ps in vectors["positionZ"].times_ps]
    assert times_s == [0.01, 1.01, 2.01, 2.05]


def test_what_a_native_protocol_tracks(make_scenario):
    scenario = make_scenario("class Tested(Quiet): pass", BEACON, "*.uavs[*].protocol.spread = 100ms")
    result = run(scenario, vectors_of=[0, 1])
    for node in result.nodes:
        vectors = {vector.name: vector for vector in node.vectors}
        assert vectors["sent"].values[-1] == node.tracked_variables["sent"] > 0
        assert len(vectors["positionX"].values) == 2


def test_times_are_exact_when_floats_no_longer_are(make_scenario):
    def delay_ps(at_s):
        limits = "sim-time-limit = 9000000s", "*.uavs[*].mobility.telemetryInterval = 0s"
        scenario = make_scenario(ONCE, *limits, f"**.at = {at_s}s")
        (time_ps,) = vectors_of(run(scenario, vectors_of=[1]), 1)["heard"].times_ps
        return time_ps - at_s * 10**12

    assert delay_ps(8_000_000) == delay_ps(1) > 0


def test_the_run_is_the_same(make_scenario):
    asked, unasked = (run(make_scenario(), vectors_of=ids) for ids in ([0, 1], []))
    assert (asked.result_hash, asked.events) == (unasked.result_hash, unasked.events)
