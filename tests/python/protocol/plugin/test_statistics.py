import csv
import math
from pathlib import Path
from unittest.mock import MagicMock

import pytest

from gradysim.protocol.plugin.dispatcher import DispatchReturn, create_dispatcher
from gradysim.protocol.plugin.statistics import (
    DATA_COLLECTION_INTERVAL,
    StatisticsProtocolWrapper,
    create_statistics,
    finish_statistics,
)

TIMES = "simulation_real_time_part_RecordingProtocol_0.csv"
TRACKED = "tracked_variables_part_RecordingProtocol_0.csv"

FLIGHT = """
from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.plugin.statistics import create_statistics, finish_statistics

class Counter(Quiet):
    def initialize(self):
        self.provider.tracked_variables["heard"] = 0
        create_statistics(self, "test", 0.25)
        self.provider.schedule_timer("talk", 0.4 + 0.2 * self.provider.get_id())

    def handle_timer(self, timer):
        assert timer == "talk"
        self.provider.send_communication_command(BroadcastMessageCommand("hello"))

    def handle_packet(self, message):
        self.provider.tracked_variables["heard"] += 1

    def finish(self):
        finish_statistics(self)
"""


@pytest.fixture(autouse=True)
def working_directory(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def provider(protocol):
    return protocol.provider


def rows(path):
    """Return the lines of a file, without their numbers."""
    with open(path, newline="", encoding="utf-8") as file:
        return [row[1:] for row in csv.reader(file)]


def test_the_default_interval_is_the_published_one(protocol, provider):
    assert DATA_COLLECTION_INTERVAL == 0.1
    create_statistics(protocol)
    assert provider.timers == [(0.1, "statistics")]


def test_it_returns_its_collector(protocol):
    assert isinstance(create_statistics(protocol), StatisticsProtocolWrapper)


def test_the_files_have_the_published_names(protocol, working_directory):
    create_statistics(protocol, "part")
    finish_statistics(protocol)
    assert {path.name for path in working_directory.iterdir()} == {TIMES, TRACKED}


def test_without_a_part_the_names_have_two_underscores(make_protocol, working_directory):
    protocol = make_protocol(node_id=7)
    create_statistics(protocol)
    finish_statistics(protocol)
    assert {path.name for path in working_directory.iterdir()} == {
        "simulation_real_time__RecordingProtocol_7.csv",
        "tracked_variables__RecordingProtocol_7.csv",
    }


def test_times_are_sampled_each_interval(protocol, provider, monkeypatch):
    monkeypatch.setattr("time.time", lambda: 1000.5 + provider.now)
    create_statistics(protocol, "part", 0.5)
    provider.pass_time(protocol, 1.2)
    finish_statistics(protocol)
    assert (
        Path(TIMES).read_text(encoding="utf-8") == ",simulation_time,real_time\n0,0.5,1001.0\n1,1.0,1001.5\n"
    )


def test_tracked_variables_are_sampled_each_interval(protocol, provider):
    create_statistics(protocol, "part", 0.5)
    provider.tracked_variables["speed"] = 1
    provider.pass_time(protocol, 0.5)
    provider.tracked_variables["name"] = "a,b"
    provider.pass_time(protocol, 1)
    finish_statistics(protocol)
    assert (
        Path(TRACKED).read_text(encoding="utf-8") == ',simulation_time,speed,name\n0,0.5,1,\n1,1.0,1,"a,b"\n'
    )


def test_late_creation_counts_from_then(protocol, provider):
    provider.pass_time(protocol, 10)
    create_statistics(protocol, "part", 0.5)
    provider.pass_time(protocol, 11)
    finish_statistics(protocol)
    assert [row[0] for row in rows(TIMES)] == ["simulation_time", "10.5", "11.0"]


def test_tracked_variables_are_sampled_after_each_packet(protocol, provider):
    protocol.handle_packet = lambda message: provider.tracked_variables.update(last=message)
    create_statistics(protocol, "part")
    provider.now = 0.05
    protocol.handle_packet("one")
    protocol.handle_packet("two")
    finish_statistics(protocol)
    assert rows(TRACKED)[1:] == [["0.05", "one"], ["0.05", "two"]]
    assert len(rows(TIMES)) == 1


def test_packets_that_a_plugin_takes_count_too(protocol):
    create_statistics(protocol, "part")
    create_dispatcher(protocol).register_handle_packet(lambda _protocol, _message: DispatchReturn.INTERRUPT)
    protocol.handle_packet("taken")
    finish_statistics(protocol)
    assert len(rows(TRACKED)) == 2


def test_a_list_is_kept_as_it_was(protocol, provider):
    create_statistics(protocol, "part", 1)
    provider.tracked_variables["path"] = path = [1]
    provider.pass_time(protocol, 1)
    path.append(2)
    provider.pass_time(protocol, 2)
    finish_statistics(protocol)
    assert rows(TRACKED)[1:] == [["1.0", "[1]"], ["2.0", "[1, 2]"]]


def test_a_variable_of_the_name_of_the_time_hides_nothing(protocol, provider):
    provider.tracked_variables["simulation_time"] = "mine"
    create_statistics(protocol, "part", 1)
    provider.pass_time(protocol, 1)
    finish_statistics(protocol)
    assert rows(TRACKED) == [["simulation_time"] * 2, ["1.0", "mine"]]


def test_tracked_variables_may_be_a_subclass_of_dict(protocol, provider):
    from gradysim.encapsulator.tracked_variables import TrackedVariables

    changes = []
    provider.tracked_variables = TrackedVariables(lambda *change: changes.append(change))
    provider.tracked_variables["speed"] = 1
    create_statistics(protocol, "part", 1)
    provider.pass_time(protocol, 1)
    finish_statistics(protocol)
    assert rows(TRACKED)[1:] == [["1.0", "1"]]
    assert changes == [("speed", 1)]


def test_other_timers_and_packets_reach_the_protocol(protocol):
    create_statistics(protocol)
    protocol.handle_timer("mine")
    protocol.handle_packet("yours")
    assert protocol.calls == [("handle_timer", "mine"), ("handle_packet", "yours")]


def test_its_timer_does_not_reach_the_protocol(protocol, provider):
    create_statistics(protocol)
    provider.pass_time(protocol, 1)
    assert protocol.calls == []


def test_creating_twice_does_not_double(protocol, provider):
    assert create_statistics(protocol, "part", 0.5) is create_statistics(protocol, "part", 0.5)
    provider.pass_time(protocol, 1)
    protocol.handle_packet("hello")
    finish_statistics(protocol)
    assert (len(rows(TIMES)), len(rows(TRACKED))) == (3, 4)


def test_creating_again_takes_the_new_name_and_interval(protocol, provider):
    create_statistics(protocol, "other", 0.5)
    create_statistics(protocol, "part", 1)
    provider.pass_time(protocol, 2)
    finish_statistics(protocol)
    assert [row[0] for row in rows(TIMES)[1:]] == ["0.5", "1.5"]


def test_after_finish_nothing_is_left(protocol, provider):
    create_statistics(protocol, "part")
    finish_statistics(protocol)
    assert provider.timers == []
    protocol.handle_timer("statistics")
    protocol.handle_packet("hello")
    assert protocol.calls == [("handle_timer", "statistics"), ("handle_packet", "hello")]
    assert len(rows(TRACKED)) == 1


def test_who_bound_the_callback_since_keeps_it(protocol):
    create_statistics(protocol)
    heard = []
    inner = protocol.handle_packet

    def outer(message):
        heard.append(message)
        inner(message)

    protocol.handle_packet = outer
    finish_statistics(protocol)
    protocol.handle_packet("hello")
    assert (heard, protocol.calls) == (["hello"], [("handle_packet", "hello")])


def test_stopping_twice_is_no_error(protocol, provider):
    collector = create_statistics(protocol)
    collector.unregister()
    collector.unregister()
    assert provider.timers == []


def test_a_collector_that_was_stopped_can_start_again(protocol, provider):
    collector = create_statistics(protocol)
    collector.unregister()
    collector.register()
    assert provider.timers == [(DATA_COLLECTION_INTERVAL, "statistics")]


def test_after_finish_a_new_collection_can_start(protocol, provider):
    create_statistics(protocol, "part", 1)
    provider.pass_time(protocol, 1)
    finish_statistics(protocol)
    create_statistics(protocol, "part", 1)
    provider.pass_time(protocol, 2)
    finish_statistics(protocol)
    assert [row[0] for row in rows(TIMES)[1:]] == ["2.0"]


def test_finishing_what_was_not_created_is_refused(protocol):
    with pytest.raises(ValueError, match="create_statistics"):
        finish_statistics(protocol)


@pytest.mark.parametrize("interval", [0, -1, math.nan, math.inf, "1"])
def test_a_bad_interval_is_refused(protocol, interval):
    with pytest.raises(ValueError, match="collection_interval"):
        create_statistics(protocol, "part", interval)


@pytest.mark.parametrize("part", ["a/b", "a\\b", 5, None])
def test_a_part_that_is_no_part_of_a_name_is_refused(protocol, part):
    with pytest.raises(ValueError, match="file_name_part"):
        create_statistics(protocol, part)


def test_a_mock_of_a_provider_has_no_name_of_a_run(protocol, provider, working_directory):
    provider.run_name = MagicMock()
    create_statistics(protocol, "part")
    finish_statistics(protocol)
    assert {path.name for path in working_directory.iterdir()} == {TIMES, TRACKED}


def test_a_run_of_several_is_in_the_names(protocol, provider, working_directory):
    provider.run_name = "Study-#3.prototype"
    create_statistics(protocol, "part")
    finish_statistics(protocol)
    assert {path.name for path in working_directory.iterdir()} == {
        "simulation_real_time_Study-#3.prototype_part_RecordingProtocol_0.csv",
        "tracked_variables_Study-#3.prototype_part_RecordingProtocol_0.csv",
    }


def test_statistics_in_a_simulation(make_scenario, run_mode):
    nodes = ["sim-time-limit = 1.1s", "*.uavs.count = 2", '*.uavs[*].protocol.class = "protocols.py:Counter"']
    run_mode(make_scenario(FLIGHT, *nodes))
    assert [row[0] for row in rows("simulation_real_time_test_Counter_0.csv")[1:]] == [
        "0.25", "0.5", "0.75", "1.0"
    ]  # fmt: skip
    table = rows("tracked_variables_test_Counter_0.csv")
    assert table[0] == ["simulation_time", "heard"]
    assert [(pytest.approx(float(time), abs=1e-3), heard) for time, heard in table[1:]] == [
        (0.25, "0"), (0.5, "0"), (0.6, "1"), (0.75, "1"), (1.0, "1")
    ]  # fmt: skip
