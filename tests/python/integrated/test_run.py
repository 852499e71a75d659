import gc
import weakref

import pytest

from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.run import IntegratedRun, run
from gradysim.scenario.errors import BadValue
from gradysim.scenario.parse.expressions import parse_value
from gradysim.scenario.schema.options import OPTIONS

PACKETS = '    def handle_packet(self, message): raise RuntimeError("spoilt")'


def test_outcomes_count_what_was_sent(make_scenario):
    outcomes = run(make_scenario()).outcomes
    assert outcomes["messages"]["broadcast"]["sent"] == 40
    assert outcomes["frames"]["broadcast"]["delivered"] == 40


def test_outcomes_of_options_are_in_all_results(make_scenario):
    """Readers of results need not check whether an outcome exists."""
    outcomes = run(make_scenario()).outcomes
    sent_to_one = ("unicast", "ack", "rts", "cts")
    kinds = {"broadcast", *sent_to_one, *(f"{kind} overheard" for kind in sent_to_one)}
    assert outcomes["frames"].keys() == kinds
    assert all(
        counts.keys() >= {"delivered", "preamble_undetected", "header_error", "captured"}
        for counts in outcomes["frames"].values()
    )
    assert outcomes["messages"]["unicast"]["channel_access_failure"] == 0


def test_position_at_the_end(make_scenario):
    scenario = make_scenario(
        "class Tested(Quiet):\n"
        "    def initialize(self):\n"
        "        self.provider.send_mobility_command(GotoCoordsMobilityCommand(0, 0, 100))",
        "*.uavs[*].mobility.speed = 10mps",
    )
    assert run(scenario).nodes[0].position == pytest.approx((0, 0, 20.5))


def test_geographic_coordinates_are_relative_to_the_scenes_origin(make_scenario):
    scenario = make_scenario(
        "class Tested(Quiet):\n"
        "    def initialize(self):\n"
        "        self.provider.send_mobility_command(GotoGeoCoordsMobilityCommand(10, 20, 5))",
        "*.coordinateSystem.sceneLatitude = 10deg",
        "*.coordinateSystem.sceneLongitude = 20deg",
    )
    assert run(scenario).nodes[0].position == pytest.approx((0, 0, 5))


def test_the_same_seed_gives_the_same_run(make_scenario):
    first, again = run(make_scenario()), run(make_scenario())
    assert first.fingerprint == again.fingerprint
    assert first.outcomes == again.outcomes


def test_another_seed_gives_another_run(make_scenario):
    talker = "class Tested(Talker): pass"
    fingerprints = {run(make_scenario(talker, f"seed-set = {seed}")).fingerprint for seed in range(3)}
    assert len(fingerprints) == 3


@pytest.mark.parametrize("python", ["class Tested(Talker): pass", f"class Tested(Talker):\n{PACKETS}"])
def test_a_run_leaves_nothing_in_memory(make_scenario, python):
    done = IntegratedRun(make_scenario(python))
    protocol = weakref.ref(done._encapsulators[0].protocol)
    try:
        done.execute()
    except RuntimeError as failure:
        failure.__traceback__ = None
    del done
    gc.collect()
    assert protocol() is None


def test_runs_in_one_process_do_not_disturb_each_other(make_scenario):
    alone = run(make_scenario()).fingerprint
    first, second = IntegratedRun(make_scenario()), IntegratedRun(make_scenario())
    first.execute()
    second.execute()
    assert {first.result().fingerprint, second.result().fingerprint} == {alone}


def test_the_longest_run_that_a_file_can_ask_for_is_the_engines():
    limit, longest_s = OPTIONS["sim-time-limit"], load_netsim().longest_run_s
    assert limit.convert(parse_value(f"{longest_s}s")) == longest_s
    with pytest.raises(BadValue):
        limit.convert(parse_value(f"{longest_s + 1}s"))


def test_a_timer_after_the_longest_run_is_never_due(make_scenario):
    scenario = make_scenario(
        "class Tested(Quiet):\n"
        "    def initialize(self):\n"
        "        self.provider.schedule_timer('tick', 9.2e6 - 1)\n"
        "        self.provider.schedule_timer('never', 1e300)\n"
        "    def handle_timer(self, timer):\n"
        "        due = self.provider.tracked_variables.get('due', [])\n"
        "        self.provider.tracked_variables['due'] = [*due, timer]\n"
        "        self.provider.schedule_timer('tick', self.provider.current_time() + 1)\n",
        "sim-time-limit = 9200000s",
        "*.uavs[*].mobility.telemetryInterval = 0s",
    )
    result = run(scenario)
    assert result.sim_time_s == 9.2e6
    assert result.nodes[0].tracked_variables == {"due": ["tick", "tick"]}
