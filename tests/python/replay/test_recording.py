"""A replay compared with the result of the same run, in both modes."""

import os
import random
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import pytest

from gradysim.integrated.run import IntegratedRun
from gradysim.prototype.run import PrototypeRun
from gradysim.replay import read_replay
from gradysim.replay.sink import ReplayWriter
from gradysim.replay.tables import FRAME_KINDS, OUTCOMES, TABLES
from gradysim.scenario import load_scenarios

CONFIGS = Path(__file__).parents[3] / "configs"
RUNS = {"integrated": IntegratedRun, "prototype": PrototypeRun}

MOVING = """
class Tested(Talker):
    def initialize(self):
        super().initialize()
        self.provider.tracked_variables["state"] = "out"
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(3, 40, 10))
    def handle_packet(self, message):
        super().handle_packet(message)
        if self.heard == 5:
            self.provider.send_communication_command(
                SendMessageCommand("you there", int(self.provider.get_id() == 0)))
"""


def record(scenario, mode, path, recorded=None):
    run = RUNS[mode](scenario, replay=ReplayWriter(path, recorded))
    run.execute()
    return run.result(), read_replay(path)


@pytest.fixture(params=sorted(RUNS))
def mode(request):
    return request.param


@pytest.fixture
def recorded(mode, make_scenario, tmp_path):
    return record(make_scenario(MOVING), mode, tmp_path / "run.html")


def sums_of(outcomes):
    sums = Counter()
    for counts in outcomes.values():
        sums.update(counts)
    return {outcome: count for outcome, count in sums.items() if count and outcome != "in_air"}


def test_its_outcomes_are_those_of_the_result(recorded):
    result, replay = recorded
    assert replay.outcomes() == sums_of(result.outcomes["frames"])


def test_a_recorded_run_is_the_same_run(mode, make_scenario, recorded):
    run = RUNS[mode](make_scenario(MOVING))
    run.execute()
    again, result = run.result(), recorded[0]
    assert (again.result_hash, again.events) == (result.result_hash, result.events)


def test_where_nodes_end(recorded):
    result, replay = recorded
    for told, node in zip(replay.positions(replay.end["time_s"]), result.nodes, strict=True):
        assert told == pytest.approx(node.position, abs=0.11)  # a step of prototype mode


def test_each_frame_says_what_caused_it(recorded):
    frames = recorded[1].table("frames")
    causes = {
        FRAME_KINDS[kind]: cause for kind, cause in zip(frames["kind"], frames["cause"], strict=True) if cause
    }
    assert causes == {"broadcast": "timer talk", "unicast": "packet"}


def test_tracked_variables_with_their_times(recorded):
    result, replay = recorded
    rows = replay.table("variables")
    last = {}
    for node, name, value, text in zip(rows["node"], rows["name"], rows["value"], rows["text"], strict=True):
        last[node, name] = text or value
    for node in result.nodes:
        assert last[node.id, "heard"] == node.tracked_variables["heard"]
        assert last[node.id, "state"] == "out"
        assert last[node.id, "finished"] == "true"


def test_timers_and_commands_are_events(recorded):
    events = recorded[1].table("events")
    texts = Counter(events["text"])
    assert texts["go to 3, 40, 10 m"] == 2
    assert texts["talk"] == 40


def test_only_what_concerns_the_chosen_nodes(mode, make_scenario, tmp_path):
    scenario = make_scenario(MOVING, "*.uavs.count = 3")
    _, replay = record(scenario, mode, tmp_path / "run.html", [2])
    assert set(replay.table("events")["node"]) == {2}
    assert set(replay.table("variables")["node"]) == {2}
    senders = replay.table("frames")["node"]
    for reception in replay.receptions():
        assert 2 in (reception.receiver, senders[reception.frame])
    assert len(replay.positions(1)) == 3


@pytest.mark.parametrize(
    ("file", "config", "overrides"),
    [
        ("zigzag.ini", "ZigZag15", ("sim-time-limit=100s",)),
        ("fading.ini", "General", ("sim-time-limit=20s",)),
        ("sensor_field.ini", "General", ("sim-time-limit=200s",)),
    ],
)
def test_every_reception_of_an_example_has_its_outcome(file, config, overrides, tmp_path):
    scenario = load_scenarios(CONFIGS / file, config, overrides=overrides)[0]
    result, replay = record(scenario, "integrated", tmp_path / "run.html")
    assert replay.outcomes() == sums_of(result.outcomes["frames"])
    lost = [r for r in replay.receptions() if r.outcome in ("interference", "noise")]
    losses = replay.table("losses")
    assert list(zip(losses["frame"], losses["receiver"], strict=True)) == [
        (r.frame, r.receiver) for r in lost
    ]
    disturbed = {(r.frame, r.receiver) for r in lost if r.outcome == "interference"}
    interferers = replay.table("interferers")
    assert set(zip(interferers["frame"], interferers["receiver"], strict=True)) == disturbed


def test_a_long_run_is_in_chunks_of_a_minute(mode, make_scenario, tmp_path):
    scenario = make_scenario(MOVING, "sim-time-limit = 200s")
    result, replay = record(scenario, mode, tmp_path / "run.html")
    assert [round(chunk.end_ns / 1e9) for chunk in replay.chunks] == [60, 120, 180, 200]
    assert replay.outcomes() == sums_of(result.outcomes["frames"])
    for time_s in random.Random(1).choices(range(200), k=20):
        assert len(replay.positions(time_s)) == 2


def test_both_modes_write_the_declared_columns(make_scenario, mode, tmp_path):
    _, replay = record(make_scenario(MOVING), mode, tmp_path / "run.html")
    for chunk in replay.chunks:
        assert {name: list(columns) for name, columns in chunk.tables.items()} == {
            name: [column.name for column in columns] for name, columns in TABLES.items()
        }


def test_the_engine_and_python_number_outcomes_and_kinds_alike(make_scenario):
    run = IntegratedRun(make_scenario())
    run.execute()
    outcomes = run.result().outcomes["frames"]
    assert tuple(outcomes["broadcast"]) == OUTCOMES[: len(outcomes["broadcast"])]
    assert tuple(kind for kind in outcomes if "overheard" not in kind) == FRAME_KINDS


def test_a_failed_run_keeps_its_replay(mode, make_scenario, tmp_path):
    scenario = make_scenario(
        "class Tested(Talker):\n"
        "    def handle_packet(self, message):\n"
        "        if self.provider.current_time() > 1: raise RuntimeError('spoilt')"
    )
    with pytest.raises(RuntimeError):
        record(scenario, mode, tmp_path / "run.html")
    replay = read_replay(tmp_path / "run.html")
    assert replay.end["complete"] is False
    assert 1 < replay.end_s < 1.2


def test_a_killed_run_keeps_what_was_written(make_scenario, tmp_path):
    make_scenario(MOVING)  # writes the files
    options = ["--replay", "all", "--mode", "prototype", "--set", "sim-time-limit=900000s", "--quiet"]
    process = subprocess.Popen(
        [sys.executable, "-m", "gradysim", "run", "test.ini", *options], cwd=tmp_path, start_new_session=True
    )
    name = "results/General-#0.prototype.html.*"
    deadline = time.monotonic() + 60
    while not any(page.read_bytes().count(b"gradysim-chunk") > 3 for page in tmp_path.glob(name)):
        assert time.monotonic() < deadline
        time.sleep(0.1)
    os.killpg(process.pid, signal.SIGKILL)  # with the process of the run
    process.wait()
    (page,) = tmp_path.glob(name)
    replay = read_replay(page)
    assert replay.end is None
    assert len(replay.chunks) >= 2
    assert replay.end_s >= 120


def test_a_replay_has_the_first_2000_bytes_of_a_message_and_500_kb_of_each_minute(
    mode, make_scenario, tmp_path
):
    python = """
class Tested(Quiet):
    def initialize(self):
        self.number = 0
        if self.provider.get_id() == 0:
            self.provider.schedule_timer("talk", 1)
    def handle_timer(self, timer):
        self.provider.send_communication_command(BroadcastMessageCommand(f"{self.number:3}" + "é" * 1050))
        self.number += 1
        if self.number < 300:
            self.provider.schedule_timer("talk", self.provider.current_time() + 0.01)
"""
    _, replay = record(make_scenario(python, "sim-time-limit = 5s"), mode, tmp_path / "run.html")
    texts = replay.table("frames")["text"]
    assert texts[0] == "  0" + "é" * 998  # 1,999 bytes: a character is not cut
    assert sum(len(text.encode()) for text in texts) == pytest.approx(500_000, abs=2000)
    assert len(texts) == 300
