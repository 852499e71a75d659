"""Nodes of a scenario that autopilots fly, in both modes."""

import asyncio
import gc
import os
import sys

import pytest

import gradysim.integrated.run
import gradysim.prototype.run
from gradysim.autopilots.scenario_flights import check_autopilots, flights_of
from gradysim.config.errors.config_error import ConfigError
from gradysim.protocol.errors import MasslessMobilityException
from gradysim.sitl.error import SitlError
from python.simulator.handler.ardupilot_mobility.flying import programs_in

FLYER = """
class Tested(Quiet):
    def initialize(self):
        self.track = self.provider.tracked_variables["track"] = []
        if self.provider.get_id() == 0:
            self.provider.send_mobility_command(GotoCoordsMobilityCommand(40, -20, 15))
    def handle_telemetry(self, telemetry):
        self.track.append((self.provider.current_time(), telemetry.current_position))
        if self.provider.get_id() == 0 and len(self.track) == 4:
            self.provider.send_mobility_command(GotoCoordsMobilityCommand(0, 10, 20))
"""

FLOWN = (
    '*.uavs[0].mobility.typename = "ArdupilotMobility"',
    '*.uavs[0].mobility.autopilotUser = ""',
    "*.uavs[0].mobility.initialZ = 10m",
    "sim-time-limit = 12s",
)

MODES = {"prototype": gradysim.prototype.run, "integrated": gradysim.integrated.run}


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    yield
    gc.collect()
    assert list(tmp_path.glob("gradysim-sitl-*")) == []
    assert programs_in(tmp_path) == []


@pytest.fixture
def flown(make_scenario, toy_copter, monkeypatch):
    """`flown(python, *settings, wrongs=...)`: a scenario whose node 0 is flown by the toy."""

    def make(python=FLYER, *settings, wrongs=None):
        monkeypatch.setenv("GRADYSIM_ARDUPILOT", str(toy_copter(wrongs)))
        return make_scenario(python, *settings, *FLOWN)

    return make


def track_of(result, node=0):
    return result.nodes[node].tracked_variables["track"]


@pytest.fixture(params=MODES, ids=list(MODES))
def mode(request):
    return MODES[request.param]


def test_a_node_is_flown_where_its_protocol_sends_it(flown, mode):
    track = track_of(mode.run(flown(FLYER, "sim-time-limit = 20s")))
    times = [time for time, _ in track]
    assert times == pytest.approx([0.5 * number for number in range(1, len(track) + 1)])
    assert track[0][1] == pytest.approx((0.5, -0.2, 10), abs=1)
    assert track[3][1][0] > 5
    assert track[-1][1] == pytest.approx((0, 10, 20), abs=1)


def test_the_flight_is_the_same_in_both_modes(flown):
    scenario = flown()
    one, other = (track_of(mode.run(scenario)) for mode in MODES.values())
    assert [time for time, _ in one] == pytest.approx([time for time, _ in other])
    for (_, here), (_, there) in zip(one, other, strict=True):
        assert here == pytest.approx(there, abs=1e-6)


def test_it_starts_where_the_file_says_in_both_modes(flown, mode):
    """The vehicle hovers near by; its node is there from the first update on."""
    at_once = (
        FLYER.replace("def initialize(self):", "def initialize(self):\n        self.note()")
        + """
    def note(self):
        self.provider.tracked_variables["start"] = self.provider.node_positions()[0]
"""
    )
    result = mode.run(flown(at_once, "sim-time-limit = 1s"))
    assert result.nodes[0].tracked_variables["start"] == (0, 0, 10)


def test_a_run_is_repeatable(flown, mode):
    scenario = flown()
    one, other = mode.run(scenario), mode.run(scenario)
    assert track_of(one) == track_of(other)
    assert one.fingerprint == other.fingerprint


def test_a_node_beside_it_has_no_mass_as_ever(flown, make_scenario, mode):
    beside = mode.run(flown())
    without = mode.run(make_scenario(FLYER, "sim-time-limit = 12s"))
    assert track_of(beside, 1) == track_of(without, 1)


def test_it_flies_in_a_notebook_too(flown, mode):
    """Where an asyncio loop runs in the same thread."""
    scenario = flown(FLYER, "sim-time-limit = 2s")

    async def cell():
        return mode.run(scenario)

    assert track_of(asyncio.run(cell())) == track_of(mode.run(scenario))


def test_its_speed_at_the_start_is_set(flown, mode):
    slow = track_of(mode.run(flown(FLYER, "*.uavs[0].mobility.speed = 2mps", "sim-time-limit = 2s")))
    fast = track_of(mode.run(flown(FLYER, "sim-time-limit = 2s")))
    assert slow[-1][1][0] < fast[-1][1][0] - 0.5


REFUSED = """
class Tested(Quiet):
    def initialize(self):
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(float("nan"), 0, 0))
"""


def test_a_command_that_means_nothing_is_refused(flown, mode):
    with pytest.raises(MasslessMobilityException, match="node 0 was sent to"):
        mode.run(flown(REFUSED))


def test_an_autopilot_that_dies_ends_the_run_and_what_was_computed_is_there(flown, mode):
    run_class = getattr(mode, f"{mode.__name__.split('.')[1].capitalize()}Run")
    run = run_class(flown(wrongs={0: {"dies_at": 10}}))
    with pytest.raises(SitlError, match=r"node 0 \(uavs\[0\]\): the autopilot ended with status 7"):
        run.execute()
    assert 1 < run.result().sim_time_s < 10
    assert len(track_of(run.result())) >= 2


def test_one_that_cannot_take_off_keeps_the_run_from_being_built(flown, mode):
    with pytest.raises(SitlError, match=r"node 0 \(uavs\[0\]\): .* the battery exploded"):
        mode.run(flown(wrongs={0: {"dies_at": "take-off"}}))


def test_a_run_that_is_dropped_leaves_nothing(flown, mode, caplog):
    run_class = getattr(mode, f"{mode.__name__.split('.')[1].capitalize()}Run")
    run = run_class(flown())
    del run
    gc.collect()
    assert caplog.records == []


def test_without_such_nodes_there_are_no_flights(make_scenario):
    assert flights_of(make_scenario()) is None


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (['*.uavs[0].mobility.autopilotPath = "nothing"'], "no autopilot at "),
        (
            ["*.uavs[0].mobility.initialZ = -5m"],
            "uavs[0]: its initial position is below the ground: z = -5 m",
        ),
        (['*.uavs[0].mobility.autopilotUser = "nosuchuser"'], "there is no user 'nosuchuser'"),
        (
            ["*.coordinateSystem.sceneLatitude = 90deg", "*.uavs[0].mobility.initialY = 5m"],
            "uavs[0]: its initial position is none",
        ),
        (['*.uavs[0].mobility.autopilotParameters = "SIM_WIND_TURB=1"'], "parameter SIM_WIND_TURB"),
    ],
)
def test_what_cannot_be_flown_is_refused_before_anything_runs(flown, settings, said):
    with pytest.raises(ConfigError) as caught:
        check_autopilots(flown(FLYER, *settings))
    assert said in str(caught.value)


def test_a_protocol_of_the_engine_obeys_no_autopilot(flown):
    with pytest.raises(ConfigError, match="an autopilot obeys protocols in Python only"):
        check_autopilots(flown(FLYER, '*.uavs[*].protocol.typename = "BeaconProtocol"'))


def test_without_pymavlink_the_error_says_what_to_install(flown, monkeypatch):
    from gradysim.sitl.dialect import load_dialect

    load_dialect.cache_clear()
    monkeypatch.setitem(sys.modules, "pymavlink.dialects.v20.ardupilotmega", None)
    with pytest.raises(ConfigError, match=r'pip install "gradysim\[sitl\]"'):
        check_autopilots(flown())


def test_the_environment_without_an_autopilot(make_scenario, monkeypatch):
    monkeypatch.delenv("GRADYSIM_ARDUPILOT", raising=False)
    monkeypatch.setenv("PATH", os.devnull)
    with pytest.raises(ConfigError, match="GRADYSIM_ARDUPILOT"):
        check_autopilots(make_scenario(FLYER, *FLOWN))
