"""Nodes of a scenario with autopilots in both modes; a toy replaces ArduCopter."""

import asyncio
import gc

import pytest

import gradysim.integrated.run
import gradysim.prototype.run
from gradysim.protocol.errors import MasslessMobilityException
from gradysim.sitl import SitlError
from python.sitl.ardupilot_mobility.flying import programs_in

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

MODES = {"prototype": gradysim.prototype.run, "integrated": gradysim.integrated.run}


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    yield
    gc.collect()
    assert list(tmp_path.glob("gradysim-sitl-*")) == []
    assert programs_in(tmp_path) == []


def track_of(result, node=0):
    return result.nodes[node].tracked_variables["track"]


@pytest.fixture(params=MODES, ids=list(MODES))
def mode(request):
    return MODES[request.param]


def test_a_node_is_flown_where_its_protocol_sends_it(flown_scenario, mode):
    track = track_of(mode.run(flown_scenario(FLYER, "sim-time-limit = 20s")))
    times = [time for time, _ in track]
    assert times == pytest.approx([0.5 * number for number in range(1, len(track) + 1)])
    assert track[0][1] == pytest.approx((0.5, -0.2, 10), abs=1)
    assert track[3][1][0] > 5
    assert track[-1][1] == pytest.approx((0, 10, 20), abs=1)


def test_sent_below_the_ground_it_stands_at_that_place(flown_scenario, mode):
    """It does not land where the straight path meets the ground."""
    landing = FLYER.replace("40, -20, 15", "40, -20, -30").replace("0, 10, 20", "40, -20, -30")
    settings = ("*.uavs[0].mobility.speed = 4mps", "sim-time-limit = 25s")
    track = track_of(mode.run(flown_scenario(landing, *settings)))
    for _, position in track[-4:]:
        assert position == pytest.approx((40, -20, 0), abs=1)


def test_the_flight_is_the_same_in_both_modes(flown_scenario):
    scenario = flown_scenario(FLYER)
    one, other = (track_of(mode.run(scenario)) for mode in MODES.values())
    assert [time for time, _ in one] == pytest.approx([time for time, _ in other])
    for (_, here), (_, there) in zip(one, other, strict=True):
        assert here == pytest.approx(there, abs=1e-6)


def test_it_starts_where_the_file_says_in_both_modes(flown_scenario, mode):
    """The vehicle hovers near its node, which has the exact position from the first update on."""
    at_once = (
        FLYER.replace("def initialize(self):", "def initialize(self):\n        self.note()")
        + """
    def note(self):
        self.provider.tracked_variables["start"] = self.provider.node_positions()[0]
"""
    )
    result = mode.run(flown_scenario(at_once, "sim-time-limit = 1s"))
    assert result.nodes[0].tracked_variables["start"] == (0, 0, 10)


def test_a_run_is_repeatable(flown_scenario, mode):
    scenario = flown_scenario(FLYER)
    one, other = mode.run(scenario), mode.run(scenario)
    assert track_of(one) == track_of(other)
    assert one.result_hash == other.result_hash


def test_a_node_beside_it_has_no_mass_as_ever(flown_scenario, make_scenario, mode):
    beside = mode.run(flown_scenario(FLYER))
    without = mode.run(make_scenario(FLYER, "sim-time-limit = 12s"))
    assert track_of(beside, 1) == track_of(without, 1)


def test_it_flies_in_a_notebook_too(flown_scenario, mode):
    """An asyncio loop runs in the same thread."""
    scenario = flown_scenario(FLYER, "sim-time-limit = 2s")

    async def cell():
        return mode.run(scenario)

    assert track_of(asyncio.run(cell())) == track_of(mode.run(scenario))


def test_its_speed_at_the_start_is_set(flown_scenario, mode):
    slow = track_of(mode.run(flown_scenario(FLYER, "*.uavs[0].mobility.speed = 2mps", "sim-time-limit = 2s")))
    fast = track_of(mode.run(flown_scenario(FLYER, "sim-time-limit = 2s")))
    assert slow[-1][1][0] < fast[-1][1][0] - 0.5


REFUSED = """
class Tested(Quiet):
    def initialize(self):
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(float("nan"), 0, 0))
"""


def test_a_command_that_means_nothing_is_refused(flown_scenario, mode):
    with pytest.raises(MasslessMobilityException, match=r"^node 0 .*nan"):
        mode.run(flown_scenario(REFUSED))


def test_an_autopilot_that_dies_ends_the_run_and_what_was_computed_is_there(flown_scenario, mode):
    run_class = getattr(mode, f"{mode.__name__.split('.')[1].capitalize()}Run")
    run = run_class(flown_scenario(FLYER, wrongs={0: {"dies_at": 10}}))
    with pytest.raises(SitlError, match=r"node 0 \(uavs\[0\]\): .*status 7"):
        run.execute()
    assert 1 < run.result().sim_time_s < 10
    assert len(track_of(run.result())) >= 2


def test_one_that_cannot_take_off_keeps_the_run_from_being_built(flown_scenario, mode):
    with pytest.raises(SitlError, match=r"node 0 \(uavs\[0\]\): .*exploded"):
        mode.run(flown_scenario(FLYER, wrongs={0: {"dies_at": "take-off"}}))


def test_a_run_that_is_dropped_leaves_nothing(flown_scenario, mode, caplog):
    run_class = getattr(mode, f"{mode.__name__.split('.')[1].capitalize()}Run")
    run = run_class(flown_scenario(FLYER))
    del run
    gc.collect()
    assert caplog.records == []
