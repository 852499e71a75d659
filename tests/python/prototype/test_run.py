import subprocess
import sys

import pytest

from gradysim.prototype.run import PrototypeRun, run
from gradysim.simulator.handler.interface import INodeHandler


def test_outcomes_count_what_was_sent(make_scenario):
    outcomes = run(make_scenario()).outcomes
    assert outcomes["messages"]["broadcast"] == {"sent": 40}
    assert outcomes["frames"]["broadcast"]["delivered"] == 40


@pytest.mark.parametrize(
    ("setting", "outcomes"),
    [
        ("*.communicationMedium.transmissionRange = 9m", (0, 40, 0, 0)),
        ("*.communicationMedium.failureRate = 1", (0, 0, 40, 0)),
        ("*.communicationMedium.delay = 0.1s", (38, 0, 0, 2)),
    ],
)
def test_the_medium_of_the_scenario_is_in_force(make_scenario, setting, outcomes):
    result = run(make_scenario("class Tested(Talker): pass", setting))
    assert tuple(result.outcomes["frames"]["broadcast"].values()) == outcomes


def test_position_at_the_end(make_scenario):
    scenario = make_scenario(
        "class Tested(Quiet):\n"
        "    def initialize(self):\n"
        "        self.provider.send_mobility_command(GotoCoordsMobilityCommand(0, 0, 100))",
        "*.uavs[*].mobility.speed = 3mps",
        "sim-time-limit = 2s",
    )
    assert run(scenario).nodes[0].position == pytest.approx((0, 0, 6))


RESTING = (
    '*.uavs[*].mobility.typename = "StationaryMobility"',
    "*.uavs[*].mobility.telemetryInterval = 0s",
    "sim-time-limit = 10s",
)


class Watching(INodeHandler):
    @staticmethod
    def get_label():
        return "watching"

    def inject(self, event_loop): ...

    def register_node(self, node): ...


def test_where_nobody_moves_or_is_told_its_place_time_that_passes_is_no_event(make_scenario):
    result = run(make_scenario("class Tested(Quiet): pass", *RESTING))
    assert (result.events, result.sim_time_s) == (1, 10)


@pytest.mark.parametrize("watched", [{"handlers": [Watching()]}, {"real_time": True}])
def test_who_may_look_between_updates_finds_each_of_them(make_scenario, wall_clock, watched):
    assert run(make_scenario("class Tested(Quiet): pass", *RESTING), **watched).events == 1000


def test_the_same_seed_gives_the_same_run(make_scenario):
    medium = "*.communicationMedium.failureRate = 0.5"
    first, again = (run(make_scenario("class Tested(Talker): pass", medium)) for _ in range(2))
    assert (first.outcomes, first.nodes, first.events) == (again.outcomes, again.nodes, again.events)


def test_the_compiled_part_is_not_needed():
    code = "import sys; sys.modules['gradysim._netsim'] = None; import gradysim.prototype.run"
    subprocess.run([sys.executable, "-c", code], check=True, env={"PYTHONPATH": ":".join(sys.path)})


def test_before_a_run_its_result_is_there(make_scenario):
    result = PrototypeRun(make_scenario()).result()
    assert (result.interrupted, result.sim_time_s, result.wall_s) == (True, 0, result.setup_s)


def test_a_run_in_which_finish_fails_is_not_complete(make_scenario):
    failing = PrototypeRun(make_scenario("class Tested(Quiet):\n    def finish(self): raise ArithmeticError"))
    with pytest.raises(ArithmeticError):
        failing.execute()
    assert failing.result().interrupted


def test_a_run_that_ctrl_c_ended_is_not_complete_but_finished(make_scenario):
    ended = PrototypeRun(
        make_scenario("class Tested(Talker):\n    def handle_timer(self, timer): raise KeyboardInterrupt")
    )
    with pytest.raises(KeyboardInterrupt):
        ended.execute()
    assert ended.result().interrupted
    assert [node.tracked_variables["finished"] for node in ended.result().nodes] == [True, True]


def test_without_a_word_a_run_does_not_wait(make_scenario, wall_clock):
    PrototypeRun(make_scenario()).execute()
    assert wall_clock.sleeps == []


def test_at_the_pace_of_the_wall_clock(make_scenario, wall_clock):
    run(make_scenario(), real_time=2)
    assert sum(wall_clock.sleeps) == pytest.approx(2.05 / 2)


@pytest.mark.parametrize("factor", [-1, float("nan"), "fast"])
def test_what_is_no_pace(make_scenario, factor):
    with pytest.raises(ValueError, match="real_time"):
        run(make_scenario(), real_time=factor)
