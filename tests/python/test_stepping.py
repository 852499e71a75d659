import pytest

import gradysim
from gradysim.integrated.run import run as run_integrated
from gradysim.prototype.run import run as run_prototype

pytest.importorskip("gradysim._netsim")

RUN = {"prototype": run_prototype, "integrated": run_integrated}

MODES = pytest.mark.parametrize("mode", RUN)

WALKER = """
import random
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand

class Tested(Talker):
    def initialize(self):
        super().initialize()
        self.drawn = []
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(100, 0, 0))

    def handle_timer(self, timer):
        super().handle_timer(timer)
        self.drawn.append(random.random())
        self.provider.tracked_variables["drawn"] = sum(self.drawn)
"""


def outcome(result):
    """What two equal runs have in common."""
    return (result.outcomes, result.nodes, result.events, result.fingerprint, result.interrupted)


@MODES
def test_a_run_in_steps_is_the_run_at_once(make_scenario, mode):
    scenario = make_scenario(WALKER)
    with gradysim.start(scenario, mode) as run:
        assert run.run_until(0.3)
        assert run.step()
        assert run.run_until(1.0)
        while run.step():
            pass
    assert outcome(run.result()) == outcome(RUN[mode](scenario))


@MODES
def test_events_at_the_time_are_run(make_scenario, mode):
    timers = "class Tested(Quiet):\n    def initialize(self): self.provider.schedule_timer('now', 0.5)\n"
    timers += "    def handle_timer(self, timer): self.provider.tracked_variables['rang'] = True"
    with gradysim.start(make_scenario(timers), mode) as run:
        run.run_until(0.49)
        assert "rang" not in run.node("uavs[1]").provider.tracked_variables
        run.run_until(0.5)
        assert run.node("uavs[1]").provider.tracked_variables["rang"]
        assert run.time_s == 0.5


@MODES
def test_a_node_shows_where_it_is_and_what_its_protocol_knows(make_scenario, mode):
    with gradysim.start(make_scenario(WALKER), mode) as run:
        run.run_until(1.0)
        node = run.node("uavs[1]")
        before_m = node.position
        run.run_until(1.5)
        assert node.position[0] > before_m[0]
        assert (node.id, node.provider.get_id()) == (1, 1)
        assert node.provider.tracked_variables["drawn"] == sum(node.protocol.drawn)


@MODES
def test_leaving_the_block_finishes_the_protocols_of_a_run_that_is_marked_as_interrupted(make_scenario, mode):
    with gradysim.start(make_scenario(), mode) as run:
        run.run_until(0.5)
        assert not run.has_ended
    assert run.has_ended
    result = run.result()
    assert (result.interrupted, result.sim_time_s) == (True, 0.5)
    assert [node.tracked_variables["finished"] for node in result.nodes] == [True, True]


@MODES
def test_a_run_that_has_ended_does_not_go_on(make_scenario, mode):
    run = gradysim.start(make_scenario(), mode)
    assert not run.run_until()
    result = run.result()
    assert not result.interrupted
    assert not run.step()
    run.finish()
    assert run.result().events == result.events


@MODES
def test_a_run_that_never_began_can_be_left(make_scenario, mode):
    with gradysim.start(make_scenario(), mode) as run:
        pass
    assert run.result().interrupted


@MODES
def test_a_protocol_that_fails_ends_the_run(make_scenario, mode):
    failing = "class Tested(Talker):\n    def handle_timer(self, timer): raise ArithmeticError"
    run = gradysim.start(make_scenario(failing), mode)
    with pytest.raises(ArithmeticError), run:
        run.run_until()
    assert run.has_ended
    assert run.result().interrupted


@MODES
def test_the_past_cannot_be_run(make_scenario, mode):
    with gradysim.start(make_scenario(), mode) as run:
        run.run_until(1.0)
        with pytest.raises(ValueError, match=r"0\.5 s: .* 1\.0 s"):
            run.run_until(0.5)


def test_a_node_that_is_missing_names_the_nearest(make_scenario):
    with (
        gradysim.start(make_scenario(), "prototype") as run,
        pytest.raises(KeyError, match=r"uav\[1\].*uavs\[1\]"),
    ):
        run.node("uav[1]")


def test_a_mode_that_is_missing(make_scenario):
    with pytest.raises(ValueError, match=r"'integrated' or 'prototype'"):
        gradysim.start(make_scenario(), "real")
