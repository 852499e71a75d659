"""The lines of a trace compared with a replay of the same run, in both modes."""

from collections import Counter
from pathlib import Path

import pytest

from gradysim.integrated.run import IntegratedRun
from gradysim.prototype.run import PrototypeRun
from gradysim.replay import read_replay
from gradysim.replay.sink import ReplayWriter, Sinks
from gradysim.replay.tables import OUTCOMES
from gradysim.replay.trace import Trace, name_width, text_line
from gradysim.scenario import load_scenarios

RUNS = {"integrated": IntegratedRun, "prototype": PrototypeRun}

TRACED = """
class Tested(Talker):
    def initialize(self):
        super().initialize()
        self.provider.tracked_variables["state"] = "out"
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(3, 40, 10))
    def handle_packet(self, message):
        super().handle_packet(message)
        self.provider.tracked_variables["state"] = "out"
        if self.heard == 5:
            self.provider.send_communication_command(
                SendMessageCommand("you there", int(self.provider.get_id() == 0)))
"""


@pytest.fixture(params=sorted(RUNS))
def mode(request):
    return request.param


@pytest.fixture
def traced(mode, make_scenario, tmp_path, capsys):
    """Trace nodes with these ids; return the lines as (time, node, event, details), and a replay."""

    def trace(nodes, python=TRACED, *settings, recorded=None):
        path = tmp_path / "run.html"
        sinks = Sinks([Trace(nodes), ReplayWriter(path, recorded)])
        RUNS[mode](make_scenario(python, *settings), replay=sinks).execute()
        lines = [line.split(maxsplit=3) for line in capsys.readouterr().out.splitlines()]
        return [(float(time_s), *rest) for time_s, *rest in lines], read_replay(path)

    return trace


def test_lines_are_in_the_order_of_time(traced):
    lines, _ = traced([0, 1])
    times = [line[0] for line in lines]
    assert times == sorted(times)
    assert {line[1] for line in lines} == {"uavs[0]", "uavs[1]"}


def test_there_is_a_line_for_each_frame_and_reception(traced):
    lines, replay = traced([0, 1])
    sent = [line for line in lines if line[2] == "tx"]
    assert [round(time_s * 1e6) for time_s, *_ in sent] == pytest.approx(
        [time_ns / 1e3 for time_ns in replay.table("frames")["time_ns"]], abs=1
    )
    expected = Counter(reception.outcome for reception in replay.receptions())
    found = Counter(details.split(": ")[1].split(",")[0] for *_, event, details in lines if event == "rx")
    assert found == {outcome: count for outcome, count in expected.items() if outcome != "in_air"}


def test_frames_have_the_numbers_of_the_replay(traced):
    lines, replay = traced([0, 1])
    numbers = [int(details.split()[0].removeprefix("#")) for *_, event, details in lines if event == "tx"]
    assert numbers == list(range(len(replay.table("frames")["node"])))


def test_only_the_chosen_nodes_are_traced(traced):
    lines, replay = traced([1])
    assert {line[1] for line in lines} == {"uavs[1]"}
    assert 0 in replay.table("frames")["node"]


def test_a_timer_comes_before_its_frame_and_that_before_its_reception(traced):
    lines, _ = traced([0, 1])
    events = [event for *_, event, _ in lines]
    first = events.index("timer")
    assert [event for event in events[first:] if event != "set"][:3] == ["timer", "tx", "rx"]


def test_a_variable_has_a_line_when_it_changes(traced):
    lines, _ = traced([0])
    settings = [details for *_, event, details in lines if event == "set"]
    assert settings.count("state = out") == 1
    assert [line for line in settings if line.startswith("heard")][:2] == ["heard = 1", "heard = 2"]
    assert settings[-1] == "finished = true"


def test_commands_have_lines(traced):
    lines, _ = traced([0])
    assert (0.0, "uavs[0]", "command", "go to 3, 40, 10 m") in lines


def test_a_unicast_frame_has_the_outcome_at_its_destination(traced, mode):
    lines, _ = traced([0])
    sent = [details for *_, event, details in lines if event == "tx" and " unicast " in details]
    assert sent
    assert all(": delivered, " in details and "packet, " in details for details in sent)
    far, _ = traced([0], TRACED, "*.uavs[*].mobility.lineStepX = 100km")
    assert all(" 0 of 1" in details for *_, event, details in far if event == "tx")


def test_a_unicast_frame_beyond_the_range_is_below_the_sensitivity(traced):
    python = """
class Tested(Quiet):
    def initialize(self):
        self.provider.send_communication_command(SendMessageCommand("hello", 1 - self.provider.get_id()))
"""
    lines, _ = traced([0], python, "*.uavs[*].mobility.lineStepX = 100km")
    (first, *_) = [details for *_, event, details in lines if event == "tx"]
    assert " to uavs[1]: below_sensitivity, " in first


def test_a_lost_frame_names_the_interferer(make_hidden_senders, capsys):
    scenario = make_hidden_senders('*.uavs[*].wlan[*].opMode = "g(erp)"')
    IntegratedRun(scenario, replay=Trace([1])).execute()
    lines = [line.split(maxsplit=3)[3] for line in capsys.readouterr().out.splitlines()]
    assert {line.split(": ")[1].split(",")[0] for line in lines} <= set(OUTCOMES)
    assert any(": interference, " in line and line.endswith(("of uavs[0]", "of uavs[2]")) for line in lines)


TOWN = load_scenarios(Path(__file__).parents[3] / "configs/town/town.ini", "SectorAntenna")[0]


def test_a_frame_below_the_sensitivity_says_what_took_its_power(capsys):
    IntegratedRun(TOWN, replay=Trace(range(9))).execute()
    lines = [line.split(maxsplit=3)[1:] for line in capsys.readouterr().out.splitlines()]
    lost = {node: details.split(": ", 1)[1] for node, event, details in lines if event == "rx"}
    assert lost["drones[2]"] == (
        "below_sensitivity, -85.6 dBm, needs -85.0 dBm (0.6 dB short): 245 m take 87.9 dB of -7.0 dBm, "
        "obstacle 'Glass pavilion' 3.9 dB, antenna of station adds 13.2 dB"
    )
    assert lost["drones[0]"].startswith("below_sensitivity, no ")
    assert "'West block' over 300 dB" in lost["drones[0]"]
    assert lost["drones[4]"] == "delivered"


def test_a_message_is_quoted_on_one_line(traced):
    python = """
class Tested(Quiet):
    def initialize(self):
        for message in ("two\\nlines", "x" * 300):
            self.provider.send_communication_command(BroadcastMessageCommand(message))
"""
    lines, replay = traced([0], python)
    sent = [details for *_, event, details in lines if event == "tx"]
    assert sent[0].endswith(r", 'two\nlines'")
    assert sent[1].endswith(f", '{'x' * 200}'…")
    assert replay.table("frames")["text"][:2] == ["two\nlines", "x" * 300]


@pytest.mark.parametrize("text", ["a\nb", "\x1b[2J", "\ud800"])
def test_names_and_values_cannot_break_a_line_or_control_the_terminal(make_scenario, capsys, text):
    python = f"""
class Tested(Talker):
    def initialize(self):
        self.provider.tracked_variables[{text!r}] = {text!r}
"""
    PrototypeRun(make_scenario(python), replay=Trace([0])).execute()
    printed = capsys.readouterr().out
    escaped = ascii(text)[1:-1]
    assert f"  set      {escaped} = {escaped}\n" in printed
    assert text not in printed


def test_receptions_after_the_end_are_left_out(traced, mode):
    delay = "*.communicationMedium.delay = 1.5s"
    lines, _ = traced([0, 1], TRACED, *([delay] if mode == "prototype" else []))
    assert max(line[0] for line in lines) <= 2.05


def test_an_output_that_takes_no_more_does_not_end_the_run(make_scenario, monkeypatch):
    def closed(*_, **__):
        raise BrokenPipeError

    monkeypatch.setattr("builtins.print", closed)
    run = PrototypeRun(make_scenario(), replay=Trace([0]))
    run.execute()
    assert not run.result().interrupted


def test_columns_are_fixed():
    assert text_line(1.25, "uavs[0]", "tx", "#0", 10) == "   1.250000  uavs[0]     tx       #0"
    assert (name_width(["a", "abc"]), name_width(["a" * 99]), name_width([])) == (3, 20, 0)
