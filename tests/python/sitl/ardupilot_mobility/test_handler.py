"""Settings of the handler: report, logs, autopilots."""

import csv
import json
import logging

from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from python.sitl.ardupilot_mobility.flying import SPEED, Flyer, build, failure_of, fly, near


def rows(tmp_path):
    with (tmp_path / "ardupilot_mobility_report.csv").open() as file:
        return list(csv.DictReader(file))


def test_the_report_counts_telemetry_and_battery(toy_copter, tmp_path):
    protocols = fly(toy_copter(), Flyer, Flyer, duration=20)
    for identifier, row in enumerate(rows(tmp_path)):
        assert int(row["node_id"]) == identifier
        assert int(row["telemetry_requests"]) == 201
        received = len(protocols[identifier].telemetry)
        assert int(row["telemetry_drops"]) + received in (200, 201)
        assert 1 <= float(row["battery_wasted"]) <= 5


def test_what_comes_late_is_dropped_and_counted(toy_copter, tmp_path):
    (protocol,) = fly(toy_copter({0: {"hangs_at": 2}}), Flyer, duration=20)
    (row,) = rows(tmp_path)
    drops = int(row["telemetry_drops"])
    assert drops > 50
    assert drops + len(protocol.telemetry) in (200, 201)


def test_the_report_can_be_left_out(toy_copter, tmp_path):
    fly(toy_copter(), Flyer, duration=0.5, generate_report=False)
    assert list(tmp_path.glob("*.csv")) == []


def test_what_autopilots_print_can_be_kept(toy_copter, tmp_path):
    failure_of(toy_copter({0: {"exits": True}}), Flyer, uav_api_log_path=tmp_path / "logs")
    assert (tmp_path / "logs/autopilot_0.log").read_text() == "no such model\n"


def test_what_autopilots_say_can_be_logged(toy_copter, caplog):
    caplog.set_level(logging.INFO)
    program = toy_copter({0: {"refuse_arming": True}})
    failure_of(program, Flyer, uav_api_log_console=True, uav_api_startup_timeout=1)
    assert any("(Flyer 0)" in message and "PreArm: " in message for message in caplog.messages)


def test_a_flight_at_another_pace_is_warned_of(toy_copter, caplog):
    fly(toy_copter({0: {"slow": True}}), Flyer, duration=5)
    (warning,) = [record.message for record in caplog.records if record.levelno == logging.WARNING]
    assert warning.startswith("node 0 (Flyer 0): ")
    assert "real_time" in warning


def test_autopilots_have_the_parameters_that_are_wished(toy_copter):
    program = toy_copter()
    fly(program, Flyer, duration=0.5, autopilot_parameters={"SIM_WIND_SPD": 5.5, "BATT_MONITOR": 0})
    parameters = json.loads(program.with_name("final_0.json").read_text())["parameters"]
    assert (parameters["SIM_WIND_SPD"], parameters["BATT_MONITOR"]) == (5.5, 0)


def test_the_environment_may_name_the_autopilot(toy_copter, monkeypatch):
    monkeypatch.setenv("GRADYSIM_ARDUPILOT", str(toy_copter()))
    assert fly(None, Flyer, duration=0.5)[0].telemetry


def test_a_handler_may_serve_one_simulation_after_another(toy_copter):
    simulator = build(toy_copter(), Flyer, duration=0.5)
    simulator.start_simulation()
    handler = simulator.nodes[0].protocol_encapsulator.provider.handlers["mobility"]
    builder = SimulationBuilder(
        SimulationConfiguration(duration=0.5, real_time=SPEED, execution_logging=False)
    )
    builder.add_handler(TimerHandler()).add_handler(handler)
    builder.add_node(Flyer, (0, 0, 10))
    again = builder.build()
    again.start_simulation()
    assert list(handler.nodes) == [0]
    assert again.nodes[0].position == near((0, 0, 10))
