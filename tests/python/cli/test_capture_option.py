"""`gradysim run --pcap`: written files, and rejected arguments."""

from functools import partial
from pathlib import Path

import pytest

from python.cli.command import Gradysim, call_gradysim, compiled
from python.quiet_protocol import QUIET

PROTOCOL = f"""{QUIET}
from gradysim.protocol.messages.communication import BroadcastMessageCommand

class Talker(Quiet):
    def initialize(self):
        self.provider.schedule_timer("talk", 1 + 0.01 * self.provider.get_id())
    def handle_timer(self, timer):
        self.provider.send_communication_command(BroadcastMessageCommand("hello"))

class Failing(Talker):
    def handle_packet(self, message):
        raise RuntimeError("spoilt")
"""

INI = """[General]
sim-time-limit = 2s
repeat = 3
*.uavs.count = 2
*.uavs[*].protocol.class = "protocol.py:Talker"
*.uavs[*].mobility.lineStepX = 10m

[Config Failing]
*.uavs[*].protocol.class = "protocol.py:Failing"
"""


@pytest.fixture
def gradysim_run(tmp_path: Path) -> Gradysim:
    """`gradysim_run(*arguments)` runs `gradysim run test.ini` in the test's directory."""
    (tmp_path / "protocol.py").write_text(PROTOCOL)
    (tmp_path / "test.ini").write_text(INI)

    return partial(call_gradysim, tmp_path, "run", "test.ini")


def names_in(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.glob("*.pcap"))


@compiled
def test_a_file_for_each_node_and_run(gradysim_run: Gradysim, tmp_path: Path) -> None:
    done = gradysim_run("-r", "0,2", "--result-dir", "out", "--pcap", "uavs[1]", "--pcap", "uavs[0]")
    names = [f"General-#{run}-uavs[{index}].pcap" for run in (0, 2) for index in (0, 1)]
    assert names_in(tmp_path / "out") == names
    assert done.stdout.split()[-1] == "out"


@compiled
def test_several_names_after_one_option(gradysim_run: Gradysim, tmp_path: Path) -> None:
    gradysim_run("-r", "0", "--pcap", "uavs[0]", "uavs[1]", "--quiet")
    assert names_in(tmp_path / "results") == ["General-#0-uavs[0].pcap", "General-#0-uavs[1].pcap"]


@compiled
def test_a_file_for_each_interface(gradysim_run: Gradysim, tmp_path: Path) -> None:
    two = ["--set", "*.uavs[1].numWlanInterfaces = 2", "--set", "*.uavs[1].wlan[1].radio.channelNumber = 5"]
    done = gradysim_run("-r", "0", "--pcap", "uavs[1]", *two)
    names = ["General-#0-uavs[1]-wlan1.pcap", "General-#0-uavs[1].pcap"]
    assert names_in(tmp_path / "results") == names
    assert all(f"results/{name}" in done.stdout for name in names)


@compiled
def test_resumed_runs_are_repeated_for_captures_that_are_missing(
    gradysim_run: Gradysim, tmp_path: Path
) -> None:
    arguments = ("-r", "0,1", "--result-dir", "out", "--quiet", "--resume")
    gradysim_run(*arguments)
    gradysim_run(*arguments, "--pcap", "uavs[0]")
    names = [f"General-#{run}-uavs[0].pcap" for run in (0, 1)]
    assert names_in(tmp_path / "out") == names
    (tmp_path / "out" / names[1]).unlink()
    done = gradysim_run(*arguments, "--pcap", "uavs[0]")
    assert "(0)" in done.stderr
    assert names_in(tmp_path / "out") == names


@compiled
def test_a_resumed_run_is_repeated_for_a_capture_of_another_run(
    gradysim_run: Gradysim, tmp_path: Path
) -> None:
    arguments = ("-r", "0", "--result-dir", "results", "--quiet", "--resume")
    gradysim_run(*arguments)
    gradysim_run("-r", "0", "--pcap", "uavs[0]", "--quiet", "--set", "sim-time-limit=1s", "--replace")
    (capture,) = (tmp_path / "results").glob("*.pcap")
    of_the_other = capture.read_bytes()
    assert gradysim_run(*arguments, "--pcap", "uavs[0]").stderr == ""
    assert len(capture.read_bytes()) > len(of_the_other)
    assert "(0)" in gradysim_run(*arguments, "--pcap", "uavs[0]").stderr


@compiled
@pytest.mark.parametrize("earlier", [(), ("--pcap", "uavs[0]")])
def test_a_resumed_run_is_repeated_for_a_capture_without_its_end(
    gradysim_run: Gradysim, tmp_path: Path, earlier: tuple[str, ...]
) -> None:
    arguments = ("-r", "0", "--result-dir", "results", "--quiet", "--resume")
    gradysim_run(*arguments, "--pcap", "uavs[0]")
    (capture,) = (tmp_path / "results").glob("*.pcap")
    whole = capture.read_bytes()
    (tmp_path / "results/General-#0.integrated.json").unlink()
    gradysim_run(*arguments, *earlier)
    capture.write_bytes(whole[:-1])  # as left by a killed run
    assert gradysim_run(*arguments, "--pcap", "uavs[0]").stderr == ""
    assert capture.read_bytes() == whole


@compiled
def test_json_stays_json(gradysim_run: Gradysim) -> None:
    done = gradysim_run("-r", "0", "--pcap", "all", "--json")
    assert len(done.stdout.splitlines()) == 1
    assert ".pcap" in done.stderr


@compiled
def test_a_failing_run_keeps_its_capture(gradysim_run: Gradysim, tmp_path: Path) -> None:
    done = gradysim_run("-c", "Failing", "--pcap", "all")
    assert done.returncode == 1
    assert (tmp_path / "results" / "Failing-#0-uavs[0].pcap").stat().st_size > 100


@compiled
def test_a_wrong_node(gradysim_run: Gradysim) -> None:
    done = gradysim_run("--pcap", "uavs[7]")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("--pcap uavs[7]: ")
    assert "`uavs[" in done.stderr


@compiled
def test_a_medium_without_radios(gradysim_run: Gradysim) -> None:
    done = gradysim_run("--pcap", "all", "--set", '*.radioMedium.typename = "UnitDiskRadioMedium"')
    assert (done.returncode, done.stdout) == (2, "")
    assert "Ieee80211ScalarRadioMedium" in done.stderr


@compiled
def test_a_file_that_cannot_be_written(gradysim_run: Gradysim, tmp_path: Path) -> None:
    (tmp_path / "out" / "General-#0-uavs[0].pcap").mkdir(parents=True)
    done = gradysim_run("--pcap", "all", "--result-dir", "out")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("out/General-#0-uavs[0].pcap: ")


def test_no_node_at_all(gradysim_run: Gradysim) -> None:
    assert gradysim_run("--pcap").returncode == 2


def test_prototype_mode_has_no_frames(gradysim_run: Gradysim) -> None:
    done = gradysim_run("--mode", "prototype", "--pcap", "all")
    assert (done.returncode, done.stdout) == (2, "")
    assert "--mode integrated" in done.stderr
