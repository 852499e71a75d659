"""Why frames were lost, as the engine recorded it."""

import math
from pathlib import Path

import pytest

from gradysim.integrated.run import IntegratedRun
from gradysim.replay import read_replay
from gradysim.replay.sink import ReplayWriter
from gradysim.scenario import load_scenarios

ROOT = Path(__file__).parents[3]
TOWN = ROOT / "configs/town/town.ini"
CLOSE_DB = 0.03  # the record has hundredths of a decibel


def record(path, file, config, *overrides):
    scenario = load_scenarios(file, config, overrides=overrides)[0]
    IntegratedRun(scenario, replay=ReplayWriter(path)).execute()
    return read_replay(path)


def free_space_db(distance_m):
    return 20 * math.log10(4 * math.pi * distance_m * 2.412e9 / 299_792_458)


def test_behind_houses_the_path_loss_is_that_of_the_distance(tmp_path):
    replay = record(tmp_path / "run.html", TOWN, "SectorAntenna", "sim-time-limit=600ms")
    losses = list(replay.losses())
    assert {loss.receiver for loss in losses} == {1, 2, 3, 4, 8}
    for loss in losses:
        assert loss.path_loss_db == pytest.approx(free_space_db(loss.distance_m), abs=CLOSE_DB)
        assert loss.needed == -85
        assert loss.sinr_db is None
    (glass,) = {gain for loss in losses if loss.receiver == 3 for _, gain in loss.obstacles}
    assert glass == pytest.approx(-3.9, abs=0.1)
    assert len(losses) == sum(count == "below_sensitivity" for *_, count in replay.receptions())
    assert len(losses) == replay.outcomes()["below_sensitivity"]


def test_what_distance_alone_takes_is_only_counted(tmp_path):
    far = ("sim-time-limit=600ms", "*.drones[*].mobility.initialX=5km")
    replay = record(tmp_path / "run.html", TOWN, "OpenField", *far)
    assert not list(replay.losses())
    assert replay.outcomes()["below_sensitivity"] == 11 * 8


def test_an_addressee_that_is_too_far_away_has_its_loss(make_scenario, tmp_path):
    python = """
class Tested(Quiet):
    def initialize(self):
        if self.provider.get_id() == 0:
            self.provider.send_communication_command(SendMessageCommand("hello", 1))
"""
    scenario = make_scenario(python, "*.uavs[*].mobility.lineStepX = 5km")
    IntegratedRun(scenario, replay=ReplayWriter(tmp_path / "run.html")).execute()
    loss = next(read_replay(tmp_path / "run.html").losses())
    assert (loss.receiver, loss.distance_m) == (1, 5000)
    assert loss.path_loss_db == pytest.approx(free_space_db(5000), abs=CLOSE_DB)
    assert loss.short_db == pytest.approx(-85 - loss.power_dbm)


def test_a_collision_has_its_sinr_and_the_powers_of_the_interferers(make_hidden_senders, tmp_path):
    scenario = make_hidden_senders('*.uavs[*].wlan[*].opMode = "g(erp)"')
    IntegratedRun(scenario, replay=ReplayWriter(tmp_path / "run.html")).execute()
    lost = [loss for loss in read_replay(tmp_path / "run.html").losses() if loss.interferers]
    assert lost
    for loss in lost:
        ((_, power_dbm),) = loss.interferers
        assert power_dbm == loss.interference_dbm
        assert loss.sinr_db == pytest.approx(loss.power_dbm - power_dbm, abs=0.1)
        assert loss.needed > loss.sinr_db
        assert loss.short_db == loss.needed - loss.sinr_db


def test_only_what_a_busy_receiver_misses_has_no_numbers(make_hidden_senders, tmp_path):
    scenario = make_hidden_senders("*.uavs[*].protocol.messages = 20")
    IntegratedRun(scenario, replay=ReplayWriter(tmp_path / "run.html")).execute()
    replay = read_replay(tmp_path / "run.html")
    explained = {(loss.frame, loss.receiver) for loss in replay.losses()}
    outcomes = {outcome for frame, node, outcome in replay.receptions() if (frame, node) not in explained}
    busy = {"receiver_transmitting", "receiver_locked", "captured"}
    assert {"receiver_locked"} <= outcomes <= busy | {"delivered", "in_air"}
    assert explained


def test_fading_and_shadowing_are_recorded(tmp_path):
    random = (
        "sim-time-limit=1s",
        '*.radioMedium.pathLoss.typename="RayleighFading"',
        "*.radioMedium.shadowing.standardDeviation=6dB",
        "*.drones[*].mobility.initialX=600m",
    )
    losses = list(record(tmp_path / "run.html", TOWN, "OpenField", *random).losses())
    assert losses
    for loss in losses:
        assert loss.path_loss_db == pytest.approx(free_space_db(loss.distance_m), abs=CLOSE_DB)
        assert set(loss.gains) == {"shadowing", "fading"}


@pytest.mark.parametrize(
    ("outcome", "settings"),
    [
        ("preamble_undetected", ['preambleDetection.typename = "ThresholdPreambleDetection"']),
        ("header_error", []),
    ],
)
def test_preambles_and_headers_have_what_they_need(make_hidden_senders, tmp_path, outcome, settings):
    lines = [f"*.uavs[*].wlan[*].radio.receiver.{line}" for line in settings]
    chunks = '*.uavs[*].wlan[*].radio.receiver.errorModel.snirMode = "chunks"'
    scenario = make_hidden_senders("*.uavs[*].protocol.messages = 20", chunks, *lines)
    IntegratedRun(scenario, replay=ReplayWriter(tmp_path / "run.html")).execute()
    replay = read_replay(tmp_path / "run.html")
    lost = {(frame, node) for frame, node, found in replay.receptions() if found == outcome}
    found = [loss for loss in replay.losses() if (loss.frame, loss.receiver) in lost]
    assert found
    assert all(loss.needed < 10 and loss.sinr_db < loss.needed + 1 for loss in found)
