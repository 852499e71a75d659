import random
import subprocess
import sys
import traceback
from contextlib import suppress

import pytest

from gradysim.prototype.run import PrototypeRun, run

PACKETS = '    def handle_packet(self, message): raise RuntimeError("spoilt")'


def test_result_of_a_whole_run(make_scenario):
    result = run(make_scenario())
    assert (result.config, result.run, result.seed, result.mode) == ("General", 0, 0, "prototype")
    assert (result.sim_time_s, result.interrupted, result.fingerprint) == (2.05, False, None)
    assert result.events > 40
    assert result.wall_s > 0
    assert result.cpu_s > 0


def test_what_the_nodes_tracked(make_scenario):
    nodes = run(make_scenario()).nodes
    assert [node.tracked_variables for node in nodes] == [{"heard": 20, "finished": True}] * 2
    assert [(node.id, node.name, node.protocol) for node in nodes] == [
        (0, "uavs[0]", "Tested"),
        (1, "uavs[1]", "Tested"),
    ]


def test_fates_count_what_was_sent(make_scenario):
    fates = run(make_scenario()).fates
    assert fates["messages"]["broadcast"] == {"sent": 40}
    assert fates["copies"]["broadcast"]["delivered"] == 40


@pytest.mark.parametrize(
    ("setting", "fates"),
    [
        ("*.communicationMedium.transmissionRange = 9m", (0, 40, 0, 0)),
        ("*.communicationMedium.failureRate = 1", (0, 0, 40, 0)),
        ("*.communicationMedium.delay = 0.1s", (38, 0, 0, 2)),
    ],
)
def test_the_medium_of_the_scenario_is_in_force(make_scenario, setting, fates):
    result = run(make_scenario("class Tested(Talker): pass", setting))
    assert tuple(result.fates["copies"]["broadcast"].values()) == fates


def test_position_at_the_end(make_scenario):
    scenario = make_scenario(
        "class Tested(Quiet):\n"
        "    def initialize(self):\n"
        "        self.provider.send_mobility_command(GotoCoordsMobilityCommand(0, 0, 100))",
        "*.uavs[*].mobility.speed = 3mps",
        "sim-time-limit = 2s",
    )
    assert run(scenario).nodes[0].position == pytest.approx((0, 0, 6))


def test_the_same_seed_gives_the_same_run(make_scenario):
    medium = "*.communicationMedium.failureRate = 0.5"
    first, again = (run(make_scenario("class Tested(Talker): pass", medium)) for _ in range(2))
    assert (first.fates, first.nodes, first.events) == (again.fates, again.nodes, again.events)


def test_pythons_global_random_is_seeded(make_scenario):
    scenario = make_scenario(
        "class Tested(Quiet):\n"
        '    def initialize(self): self.provider.tracked_variables["drawn"] = random.random()',
        "seed-set = 5",
    )
    random.seed(1)
    stream = random.Random(5)
    drawn = [node.tracked_variables["drawn"] for node in run(scenario).nodes]
    assert drawn == [stream.random(), stream.random()]


def test_progress_ends_at_the_limit(make_scenario):
    times = []
    run(make_scenario(), progress=times.append)
    assert times[-1] == 2.05


def test_a_run_that_is_stopped_is_finished_and_marked(make_scenario):
    scenario = make_scenario("class Tested(Talker): pass", "sim-time-limit = 1000h")
    result = run(scenario, should_stop=lambda: True)
    assert result.interrupted
    assert 0 < result.sim_time_s < 3_600_000
    assert result.nodes[0].tracked_variables["finished"]


def test_a_keyboard_interrupt_stops_likewise(make_scenario):
    scenario = make_scenario("class Tested(Talker):\n    def handle_packet(self, m): raise KeyboardInterrupt")
    result = run(scenario)
    assert result.interrupted
    assert result.sim_time_s == pytest.approx(0.1)
    assert result.nodes[0].tracked_variables["finished"]


@pytest.mark.parametrize("callback", ["initialize", "finish"])
def test_a_keyboard_interrupt_before_or_after_the_events(make_scenario, callback):
    scenario = make_scenario(f"class Tested(Quiet):\n    def {callback}(self): raise KeyboardInterrupt")
    interrupted = PrototypeRun(scenario)
    with suppress(KeyboardInterrupt):  # that of `finish` comes through: there is nothing left to do
        interrupted.execute()
    assert interrupted.result().interrupted


def test_an_exception_in_a_protocol_comes_out_with_its_place(make_scenario):
    with pytest.raises(RuntimeError, match="spoilt") as failure:
        run(make_scenario(f"class Tested(Talker):\n{PACKETS}"))
    assert failure.value.__notes__ == ["in handle_packet of node 1 (Tested 1) at 0.1 s of simulated time"]
    assert PACKETS.partition(": ")[2] in traceback.format_tb(failure.tb)[-1]


def test_what_a_failed_run_computed_is_not_lost(make_scenario):
    failing = PrototypeRun(make_scenario(f"class Tested(Talker):\n{PACKETS}"))
    with pytest.raises(RuntimeError):
        failing.execute()
    result = failing.result()
    assert result.interrupted
    assert result.sim_time_s == pytest.approx(0.1)
    assert result.fates["messages"]["broadcast"] == {"sent": 1}


def test_the_compiled_part_is_not_needed():
    code = "import sys; sys.modules['gradysim._netsim'] = None; import gradysim.prototype.run"
    subprocess.run([sys.executable, "-c", code], check=True, env={"PYTHONPATH": ":".join(sys.path)})


def test_at_the_pace_of_the_wall_clock(make_scenario, wall_clock):
    run(make_scenario(), real_time=2)
    assert sum(wall_clock.sleeps) == pytest.approx(2.05 / 2)


@pytest.mark.parametrize("factor", [-1, float("nan"), "fast"])
def test_what_is_no_pace(make_scenario, factor):
    with pytest.raises(ValueError, match="real_time must be a bool or a finite factor >= 0, got "):
        run(make_scenario(), real_time=factor)
