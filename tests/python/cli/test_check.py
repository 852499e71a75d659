"""`gradysim check`: all errors and warnings of a file at once."""

from pathlib import Path

import pytest

from gradysim.cli.app import main

PROTOCOL = """
from gradysim.protocol.interface import IProtocol


class Quiet(IProtocol):
    def initialize(self): pass
    def handle_timer(self, timer): pass
    def handle_packet(self, message): pass
    def handle_telemetry(self, telemetry): pass
    def finish(self): pass
"""

BASE = """sim-time-limit = 10s
*.numUavs = 2
*.uavs[*].protocol.class = "quiet.py:Quiet"
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    (tmp_path / "quiet.py").write_text(PROTOCOL)
    (tmp_path / "test.ini").write_text(BASE)
    return tmp_path / "test.ini"


def lines_of(output: str, file: Path) -> list[int]:
    reports = [line for line in output.splitlines() if line.startswith(f"{file}:")]
    return [int(report.removeprefix(f"{file}:").partition(":")[0]) for report in reports]


def test_a_valid_file_has_exit_code_0(file: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["check", str(file)]) == 0
    assert lines_of(capfd.readouterr().out, file) == []


def test_errors_of_all_lines_are_reported_in_their_order(
    file: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    file.write_text(
        "sim-time-limt = 3s\n"
        + BASE
        + "**.transmitter.powr = 1mW\n*.uavs[*].mobility.speed = fast\n*.radioMedium.pathLoss.alpha = 3m\n"
    )
    assert main(["check", str(file)]) == 2
    assert lines_of(capfd.readouterr().out, file) == [1, 5, 6, 7]


def test_errors_of_the_engine_are_reported_for_each_struct(
    file: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    file.write_text(BASE + "*.uavs[0].wlan[*].bitrate = 3.14Mbps\n*.uavs[1].wlan[*].bitrate = 1.23Mbps\n")
    assert main(["check", str(file)]) == 2
    assert lines_of(capfd.readouterr().out, file) == [4, 5]


def test_all_configurations_are_checked_unless_one_is_named(
    file: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    file.write_text(BASE + "[A]\n**.powr = 1mW\n[B]\n**.bitrat = 1Mbps\n")
    assert main(["check", str(file)]) == 2
    assert lines_of(capfd.readouterr().out, file) == [5, 7]
    assert main(["check", str(file), "-c", "B"]) == 2
    assert lines_of(capfd.readouterr().out, file) == [7]


def test_warnings_alone_have_exit_code_0(file: Path, capfd: pytest.CaptureFixture[str]) -> None:
    file.write_text(BASE + "**.mobility.speed = 3mps\n*.uavs[0].mobility.speed = 5mps\n")
    assert main(["check", str(file)]) == 0
    assert lines_of(capfd.readouterr().out, file) == [5]


def test_a_file_that_cannot_be_read_has_exit_code_2(tmp_path: Path) -> None:
    assert main(["check", str(tmp_path / "missing.ini")]) == 2


def test_run_reports_all_errors_too(file: Path, capfd: pytest.CaptureFixture[str]) -> None:
    file.write_text(BASE + "**.transmitter.powr = 1mW\n*.uavs[*].mobility.speed = fast\n")
    assert main(["run", str(file)]) == 2
    assert lines_of(capfd.readouterr().err, file) == [4, 5]


@pytest.mark.parametrize("command", ["check", "run"])
@pytest.mark.parametrize("line", ["no entry", "*.uavs[*].mobility.sped = 3mps"])
def test_of_many_errors_the_first_hundred_are_reported(
    file: Path, capfd: pytest.CaptureFixture[str], command: str, line: str
) -> None:
    lines = (line.replace("=", f"{number}=") for number in range(300))
    file.write_text(BASE + "".join(f"{each}\n" for each in lines))
    assert main([command, str(file)]) == 2
    assert lines_of("".join(capfd.readouterr()), file) == list(range(4, 104))
