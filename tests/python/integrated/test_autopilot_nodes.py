"""Nodes of the engine with autopilots; the tests play the autopilots."""

import gc

import pytest

from gradysim.integrated.run import IntegratedRun, run
from gradysim.sitl import SitlError
from python.played_flights import PlayedFlights

TELEMETRY = "*.uavs[*].mobility.telemetryInterval = 0.01s"
LIMIT = "sim-time-limit = 0.05s"

TRACKED = """
class Tested(Quiet):
    def initialize(self):
        self.track = self.provider.tracked_variables["track"] = []
    def handle_telemetry(self, telemetry):
        self.track.append(telemetry.current_position)
"""


@pytest.fixture
def flights(monkeypatch):
    flights = PlayedFlights()
    monkeypatch.setattr("gradysim.integrated.autopilot_nodes.flights_of", lambda scenario: flights)
    return flights


def track_of(result, node):
    return result.nodes[node].tracked_variables["track"]


def test_a_flown_node_is_where_its_vehicle_is_and_the_other_stays(flights, make_scenario):
    result = run(make_scenario(TRACKED, TELEMETRY, LIMIT))
    assert track_of(result, 0) == [pytest.approx((0.01 * number, 0, 5)) for number in range(1, 6)]
    assert track_of(result, 1) == [(10, 0, 0)] * 5


ASKING = """
class Tested(Quiet):
    def initialize(self):
        self.provider.schedule_timer("", 0.0225)
    def handle_timer(self, timer):
        self.provider.tracked_variables["place"] = self.provider.node_positions()[0]
"""


def test_between_two_updates_it_goes_straight_on(flights, make_scenario):
    result = run(make_scenario(ASKING, LIMIT))
    assert result.nodes[0].tracked_variables["place"] == pytest.approx((0.0225, 0, 5))


def test_autopilots_are_one_update_ahead(flights, make_scenario):
    run(make_scenario(TRACKED, LIMIT))
    times = [entry for entry in flights.diary if isinstance(entry, float)]
    assert times == pytest.approx([0.01, 0.02, 0.03, 0.04, 0.05, 0.06])


ANSWERING = """
class Tested(Quiet):
    def handle_telemetry(self, telemetry):
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(self.provider.get_id(), 7, 0))
"""


def test_what_answers_telemetry_comes_before_the_next_flight_and_to_the_autopilot_alone(
    flights, make_scenario
):
    flights.pilots[0].go_to = flights.diary.append
    run(make_scenario(ANSWERING, TELEMETRY, LIMIT))
    assert flights.diary[:5] == ["begin", 0.01, (0, 7, 0), 0.02, (0, 7, 0)]


ANSWERING_LATER = """
class Tested(Quiet):
    def handle_telemetry(self, telemetry):
        self.provider.schedule_timer("", self.provider.current_time())
    def handle_timer(self, timer):
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(self.provider.get_id(), 7, 0))
"""


@pytest.mark.parametrize("interval", ["0.005s", "0.01s"])
def test_so_does_what_a_timer_of_the_same_instant_answers(flights, make_scenario, interval):
    flights.pilots[0].go_to = flights.diary.append
    run(make_scenario(ANSWERING_LATER, f"*.uavs[*].mobility.telemetryInterval = {interval}", LIMIT))
    for number in range(2, 6):
        flight = flights.diary.index(pytest.approx(0.01 * number))
        assert flights.diary[flight - 1] == (0, 7, 0)


def test_an_autopilot_that_dies_ends_the_run_where_it_is(flights, make_scenario, monkeypatch):
    def advance_to(time_s):
        if time_s > 0.03:
            raise SitlError("spoilt")

    monkeypatch.setattr(flights, "advance_to", advance_to)
    integrated_run = IntegratedRun(make_scenario(TRACKED, TELEMETRY, LIMIT))
    with pytest.raises(SitlError, match=r"^spoilt$"):
        integrated_run.execute()
    assert flights.diary == ["begin", "close"]
    assert len(track_of(integrated_run.result(), 0)) == 3


def test_those_of_a_run_that_is_dropped_are_ended(flights, make_scenario):
    integrated_run = IntegratedRun(make_scenario(TRACKED))
    del integrated_run
    gc.collect()
    assert flights.diary == ["begin", "close"]
