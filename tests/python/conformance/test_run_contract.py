"""Interface of a run, and the ways in which it may end: the same in both modes."""

import random
import re
import traceback
from itertools import chain, repeat

import pytest

from gradysim.integrated.run import IntegratedRun
from gradysim.protocol.errors import TimerException
from gradysim.prototype.run import PrototypeRun

PACKETS = '    def handle_packet(self, message): raise RuntimeError("spoilt")'
MODES = {"integrated": IntegratedRun, "prototype": PrototypeRun}


@pytest.fixture(params=MODES)
def mode(request):
    return request.param


@pytest.fixture
def make_run(mode, make_scenario):
    """`make_run(python, *settings)`: a run in that mode, not yet executed."""
    return lambda *scenario: MODES[mode](make_scenario(*scenario))


@pytest.fixture
def result_of(make_run):
    """`result_of(python, *settings)`: the result of a complete run."""

    def run(*scenario):
        made = make_run(*scenario)
        made.execute()
        return made.result()

    return run


@pytest.mark.parametrize("wrong", ["town.ini", [], None])
def test_what_is_no_scenario_is_refused_with_what_was_expected(mode, wrong):
    with pytest.raises(TypeError, match=r"load_scenarios"):
        MODES[mode](wrong)


def test_result_of_a_whole_run(result_of, mode):
    result = result_of()
    assert (result.config, result.run, result.seed, result.mode) == ("General", 0, 0, mode)
    assert (result.sim_time_s, result.interrupted) == (2.05, False)
    assert result.events > 40
    assert result.wall_s > 0
    assert result.cpu_s > 0


def test_the_cost_counts_from_building_to_the_end(result_of, monkeypatch):
    for clock, begin, end in (("perf_counter", 10.0, 12.5), ("process_time", 3.0, 4.0)):
        times = chain([begin], repeat(end))
        monkeypatch.setattr(f"gradysim.execution.scenario_run.{clock}", times.__next__)
    result = result_of()
    assert (result.wall_s, result.cpu_s, result.setup_s) == (2.5, 1.0, 2.5)


def test_what_the_nodes_tracked(result_of):
    nodes = result_of("class Tested(Talker): pass").nodes
    assert [node.tracked_variables for node in nodes] == [{"heard": 20, "finished": True}] * 2
    assert [(node.id, node.name, node.protocol) for node in nodes] == [
        (0, "uavs[0]", "Tested"),
        (1, "uavs[1]", "Tested"),
    ]


def test_parameters_are_in_force_when_the_protocol_is_made(result_of):
    result = result_of(
        "class Tested(Quiet):\n"
        "    pace = 1\n"
        "    def __init__(self): self.seen = self.pace\n"
        '    def initialize(self): self.provider.tracked_variables["seen"] = self.seen',
        "*.uavs[1].protocol.pace = 5",
    )
    assert [node.tracked_variables for node in result.nodes] == [{"seen": 1}, {"seen": 5}]
    assert {node.protocol for node in result.nodes} == {"Tested"}


def test_python_looks_for_garbage_during_a_run_but_not_while_it_is_built(result_of):
    result = result_of(
        "import gc\n"
        "class Tested(Quiet):\n"
        "    def __init__(self): self.seen = [gc.isenabled()]\n"
        "    def initialize(self):\n"
        "        self.seen.append(gc.isenabled())\n"
        '        self.provider.tracked_variables["seen"] = self.seen'
    )
    assert [node.tracked_variables["seen"] for node in result.nodes] == [[False, True]] * 2


def test_pythons_global_random_is_the_scripts_again(make_run):
    drawing = (
        "import random\n"
        "class Tested(Quiet):\n"
        "    def __init__(self): random.random()\n"
        '    def initialize(self): self.provider.schedule_timer("fail", 0.5)\n'
        "    def handle_timer(self, timer): raise ValueError(random.random())"
    )
    random.seed(42)
    of_the_script = random.getstate()
    made = make_run(drawing)
    assert random.getstate() == of_the_script
    with pytest.raises(ValueError, match=r"0\."):
        made.execute()
    assert random.getstate() == of_the_script


def test_pythons_global_random_is_seeded(result_of):
    random.seed(1)
    result = result_of(
        "class Tested(Quiet):\n"
        '    def initialize(self): self.provider.tracked_variables["drawn"] = random.random()',
        "seed-set = 5",
    )
    stream = random.Random(5)
    drawn = [node.tracked_variables["drawn"] for node in result.nodes]
    assert drawn == [stream.random(), stream.random()]


def test_progress_ends_at_the_limit(make_run):
    times = []
    make_run().execute(progress=times.append)
    assert times[-1] == 2.05


def test_a_run_that_is_stopped_is_finished_and_marked(make_run):
    stopped = make_run("class Tested(Talker): pass", "sim-time-limit = 1000h")
    stopped.execute(should_stop=lambda: True)
    result = stopped.result()
    assert result.interrupted
    assert 0 < result.sim_time_s < 3_600_000
    assert result.nodes[0].tracked_variables["finished"]


def test_a_keyboard_interrupt_stops_likewise_and_is_passed_on(make_run):
    interrupted = make_run("class Tested(Talker):\n    def handle_packet(self, m): raise KeyboardInterrupt")
    with pytest.raises(KeyboardInterrupt):
        interrupted.execute()
    result = interrupted.result()
    assert result.interrupted
    assert result.sim_time_s == pytest.approx(0.1, abs=0.01)
    assert result.nodes[0].tracked_variables["finished"]


@pytest.mark.parametrize("callback", ["initialize", "finish"])
def test_a_keyboard_interrupt_before_or_after_the_events(make_run, callback):
    interrupted = make_run(f"class Tested(Quiet):\n    def {callback}(self): raise KeyboardInterrupt")
    with pytest.raises(KeyboardInterrupt):
        interrupted.execute()
    assert interrupted.result().interrupted


def test_an_exception_in_a_protocol_comes_out_with_its_place(make_run):
    with pytest.raises(RuntimeError, match="spoilt") as failure:
        make_run(f"class Tested(Talker):\n{PACKETS}").execute()
    (note,) = failure.value.__notes__
    assert re.fullmatch(r"in handle_packet of node 1 \(Tested 1\) at 0\.1\S* s .*", note)
    assert PACKETS.partition(": ")[2] in traceback.format_tb(failure.tb)[-1]


@pytest.mark.parametrize("callback", ["initialize", "finish"])
def test_the_callback_is_named(make_run, callback):
    with pytest.raises(ZeroDivisionError) as failure:
        make_run(f"class Tested(Quiet):\n    def {callback}(self): 1 / 0").execute()
    assert failure.value.__notes__[0].startswith(f"in {callback} ")


def test_a_protocol_that_cannot_be_made_is_named(make_run):
    with pytest.raises(ZeroDivisionError) as failure:
        make_run("class Tested(Quiet):\n    def __init__(self): 1 / 0")
    assert failure.value.__notes__ == ["in __init__ of node 0 (Tested 0) at 0 s of simulated time"]


def test_a_wrong_command_fails_in_the_protocol_that_gave_it(make_run):
    wrong = 'class Tested(Talker):\n    def handle_packet(self, m): self.provider.schedule_timer("a", 0)'
    with pytest.raises(TimerException) as failure:
        make_run(wrong).execute()
    assert failure.value.__notes__[0].startswith("in handle_packet ")


def test_what_a_failed_run_computed_is_not_lost(make_run):
    failing = make_run(f"class Tested(Talker):\n{PACKETS}")
    with pytest.raises(RuntimeError):
        failing.execute()
    result = failing.result()
    assert result.interrupted
    assert result.sim_time_s == pytest.approx(0.1, abs=0.01)
    assert result.outcomes["messages"]["broadcast"]["sent"] == 1
