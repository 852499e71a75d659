import gc
import random
import traceback
import weakref
from contextlib import suppress

import pytest

from gradysim.config.error import BadValue
from gradysim.config.expression import parse_value
from gradysim.config.keys.options import OPTIONS
from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.run import IntegratedRun, run
from gradysim.protocol.errors import TimerException

PACKETS = '    def handle_packet(self, message): raise RuntimeError("spoilt")'


def test_result_of_a_whole_run(make_scenario):
    result = run(make_scenario())
    assert (result.config, result.run, result.seed, result.mode) == ("General", 0, 0, "integrated")
    assert (result.sim_time_s, result.interrupted) == (2.05, False)
    assert len(result.fingerprint) == 16
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
    assert fates["messages"]["broadcast"]["sent"] == 40
    assert fates["frames"]["broadcast"]["delivered"] == 40


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


def test_parameters_are_in_force_when_the_protocol_is_made(make_scenario):
    scenario = make_scenario(
        "class Tested(Quiet):\n"
        "    pace = 1\n"
        "    def __init__(self): self.seen = self.pace\n"
        '    def initialize(self): self.provider.tracked_variables["seen"] = self.seen',
        "*.uavs[1].protocol.pace = 5",
    )
    result = run(scenario)
    assert [node.tracked_variables for node in result.nodes] == [{"seen": 1}, {"seen": 5}]
    assert {node.protocol for node in result.nodes} == {"Tested"}


def test_the_same_seed_gives_the_same_run(make_scenario):
    first, again = run(make_scenario()), run(make_scenario())
    assert first.fingerprint == again.fingerprint
    assert first.fates == again.fates


def test_another_seed_gives_another_run(make_scenario):
    talker = "class Tested(Talker): pass"
    fingerprints = {run(make_scenario(talker, f"seed-set = {seed}")).fingerprint for seed in range(3)}
    assert len(fingerprints) == 3


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
    result = run(
        make_scenario("class Tested(Talker):\n    def handle_packet(self, message): raise KeyboardInterrupt")
    )
    assert result.interrupted
    assert result.sim_time_s == pytest.approx(0.1, abs=0.01)
    assert result.nodes[0].tracked_variables["finished"]


@pytest.mark.parametrize("callback", ["initialize", "finish"])
def test_a_keyboard_interrupt_before_or_after_the_events(make_scenario, callback):
    scenario = make_scenario(f"class Tested(Quiet):\n    def {callback}(self): raise KeyboardInterrupt")
    interrupted = IntegratedRun(scenario)
    with suppress(KeyboardInterrupt):  # that of `finish` comes through: there is nothing left to do
        interrupted.execute()
    assert interrupted.result().interrupted


def test_an_exception_in_a_protocol_comes_out_with_its_place(make_scenario):
    with pytest.raises(RuntimeError, match="spoilt") as failure:
        run(make_scenario(f"class Tested(Talker):\n{PACKETS}"))
    (note,) = failure.value.__notes__
    assert note.startswith("in handle_packet of node 1 (Tested 1) at 0.1")
    assert note.endswith(" s of simulated time")


def test_its_traceback_shows_the_users_line(make_scenario):
    with pytest.raises(RuntimeError) as failure:
        run(make_scenario(f"class Tested(Talker):\n{PACKETS}"))
    assert PACKETS.partition(": ")[2] in traceback.format_tb(failure.tb)[-1]


@pytest.mark.parametrize("callback", ["initialize", "finish"])
def test_the_callback_is_named(make_scenario, callback):
    with pytest.raises(ZeroDivisionError) as failure:
        run(make_scenario(f"class Tested(Quiet):\n    def {callback}(self): 1 / 0"))
    assert failure.value.__notes__[0].startswith(f"in {callback} of node 0 (Tested 0) at ")


def test_a_protocol_that_cannot_be_made_is_named(make_scenario):
    with pytest.raises(ZeroDivisionError) as failure:
        run(make_scenario("class Tested(Quiet):\n    def __init__(self): 1 / 0"))
    assert failure.value.__notes__ == ["in __init__ of node 0 (Tested 0) at 0 s of simulated time"]


def test_a_wrong_command_fails_in_the_protocol_that_gave_it(make_scenario):
    scenario = make_scenario(
        'class Tested(Talker):\n    def handle_packet(self, m): self.provider.schedule_timer("a", 0)'
    )
    with pytest.raises(TimerException) as failure:
        run(scenario)
    assert failure.value.__notes__[0].startswith("in handle_packet of node 1 ")


def test_what_a_failed_run_computed_is_not_lost(make_scenario):
    failing = IntegratedRun(make_scenario(f"class Tested(Talker):\n{PACKETS}"))
    with pytest.raises(RuntimeError):
        failing.execute()
    result = failing.result()
    assert result.interrupted
    assert result.sim_time_s == pytest.approx(0.1, abs=0.01)
    assert result.fates["frames"]["broadcast"]["delivered"] == 1


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
