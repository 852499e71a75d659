import errno
import os
import resource
from contextlib import contextmanager
from pathlib import Path

import pytest

from gradysim.integrated.capture import CaptureError, capture_files, checked_captures, files_of_interfaces
from gradysim.integrated.run import IntegratedRun, run
from gradysim.scenario.errors import ConfigError

UNIT_DISK = '*.radioMedium.typename = "UnitDiskRadioMedium"'
FAILING = 'class Tested(Talker):\n    def handle_packet(self, message): raise RuntimeError("spoilt")'
HEADER_BYTES = 24


def test_files_are_named_after_configuration_run_and_node(make_scenario):
    assert capture_files(make_scenario(), ["uavs[1]"], Path("out")) == {
        1: Path("out/General-#0-uavs[1].pcap")
    }


def test_each_further_interface_has_a_file_of_its_own(make_scenario):
    scenario = make_scenario("class Tested(Talker): pass", "*.uavs[1].numWlanInterfaces = 3")
    files = capture_files(scenario, ["uavs"], Path("out"))
    assert {key: path.name for key, path in files_of_interfaces(scenario, files).items()} == {
        (0, 0): "General-#0-uavs[0].pcap",
        (1, 0): "General-#0-uavs[1].pcap",
        (1, 1): "General-#0-uavs[1]-wlan1.pcap",
        (1, 2): "General-#0-uavs[1]-wlan2.pcap",
    }


@pytest.mark.parametrize(
    "captures", ["all", [0], {"uavs[0]": "a.pcap"}, {(0, 1): "a.pcap"}, {0: 3}, {0: b"a"}]
)
def test_what_are_no_files_of_nodes_is_refused(make_scenario, captures):
    with pytest.raises(TypeError, match=r"^captures = "):
        checked_captures(captures, make_scenario())


@pytest.mark.parametrize("node_id", [-1, 2])
def test_a_node_that_is_not_there_is_refused(make_scenario, node_id):
    with pytest.raises(ValueError, match=f"^captures: .* {node_id}; "):
        IntegratedRun(make_scenario(), {node_id: "a.pcap"})


def test_one_file_for_two_nodes_is_refused(make_scenario, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(
        ValueError,
        match=r"^captures: wlan\[0\] .* 0 .* wlan\[0\] .* 1 .*'x/../a.pcap'",
    ):
        IntegratedRun(make_scenario(), {0: tmp_path / "a.pcap", 1: "x/../a.pcap"})
    assert not (tmp_path / "a.pcap").exists()


def test_a_further_interface_does_not_write_the_file_of_another_node(make_scenario):
    scenario = make_scenario("class Tested(Talker): pass", "*.uavs[0].numWlanInterfaces = 2")
    with pytest.raises(ValueError, match=r"^captures: wlan\[1\] .* 0 .* wlan\[0\] .* 1 "):
        checked_captures({0: "a.pcap", 1: "a-wlan1.pcap"}, scenario)


def test_a_path_may_be_a_text(make_scenario, tmp_path):
    run(make_scenario(), captures={0: str(tmp_path / "a.pcap")})
    assert (tmp_path / "a.pcap").stat().st_size > HEADER_BYTES


def test_a_unit_disk_medium_has_nothing_to_capture(make_scenario, tmp_path):
    scenario = make_scenario("class Tested(Talker): pass", UNIT_DISK)
    with pytest.raises(ConfigError, match="Ieee80211ScalarRadioMedium"):
        IntegratedRun(scenario, {0: tmp_path / "a"})


def test_a_file_that_cannot_be_written_is_found_before_the_run(make_scenario, tmp_path):
    with pytest.raises(ConfigError, match=os.strerror(errno.EISDIR)):
        IntegratedRun(make_scenario(), {0: tmp_path})


def test_a_folder_that_cannot_be_made_is_found_before_the_run(make_scenario, tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(ConfigError, match=r"file/a\.pcap"):
        IntegratedRun(make_scenario(), {0: tmp_path / "file" / "a.pcap"})


def test_a_capture_does_not_change_the_run(make_scenario, tmp_path):
    with_capture = run(make_scenario(), captures={0: tmp_path / "new" / "a.pcap"})
    assert with_capture.result_hash == run(make_scenario()).result_hash


def test_the_file_is_complete_after_a_failure(make_scenario, tmp_path):
    failing = IntegratedRun(make_scenario(FAILING), {0: tmp_path / "a.pcap"})
    with pytest.raises(RuntimeError, match="spoilt"):
        failing.execute()
    assert (tmp_path / "a.pcap").stat().st_size > HEADER_BYTES


def test_the_file_is_complete_after_an_interruption(make_scenario, tmp_path):
    interrupted = IntegratedRun(make_scenario(), {0: tmp_path / "a.pcap"})
    interrupted.execute(should_stop=lambda: True)
    assert interrupted.result().interrupted
    assert (tmp_path / "a.pcap").stat().st_size > HEADER_BYTES


@contextmanager
def full_disk():
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (2 * HEADER_BYTES, limits[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)


def test_a_file_that_lacks_its_end(make_scenario, tmp_path):
    captured = IntegratedRun(make_scenario(), {0: tmp_path / "a.pcap"})
    with (
        full_disk(),
        pytest.raises(CaptureError, match=rf"a\.pcap': {os.strerror(errno.EFBIG)}"),
    ):
        captured.execute()
    assert captured.result().interrupted


def test_a_file_that_lacks_its_end_is_told_beside_what_a_protocol_raised(make_scenario, tmp_path):
    failing = IntegratedRun(make_scenario(FAILING), {0: tmp_path / "a.pcap"})
    with full_disk(), pytest.raises(RuntimeError, match="spoilt") as caught:
        failing.execute()
    assert caught.value.__context__ is None
    (note,) = caught.value.__notes__[1:]
    assert f"'{tmp_path}/a.pcap': {os.strerror(errno.EFBIG)}" in note


@pytest.fixture
def odd_folder(tmp_path):
    """Return a directory whose name is not UTF-8."""
    folder = tmp_path / os.fsdecode(b"r\xfe")
    folder.mkdir()
    return folder


def test_a_name_may_be_any_bytes(make_scenario, odd_folder):
    run(make_scenario(), captures={0: odd_folder / "a.pcap"})
    assert (odd_folder / "a.pcap").stat().st_size > HEADER_BYTES


def test_a_name_of_any_bytes_that_cannot_be_written_is_told(make_scenario, odd_folder):
    with pytest.raises(ConfigError) as caught:
        IntegratedRun(make_scenario(), {0: odd_folder})
    assert str(caught.value).endswith(f"'{odd_folder}': {os.strerror(errno.EISDIR)}")


def test_a_file_with_a_name_of_any_bytes_that_lacks_its_end_is_told(make_scenario, odd_folder):
    captured = IntegratedRun(make_scenario(), {0: odd_folder / "a.pcap"})
    with full_disk(), pytest.raises(CaptureError) as caught:
        captured.execute()
    assert f"'{odd_folder}/a.pcap': {os.strerror(errno.EFBIG)}" in str(caught.value)
