"""Statistics have the same rows in both modes, except for wall time."""

import csv
from pathlib import Path

import pytest
from perfect_channel import Case
from watched_run import assert_same, trace_case

from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.plugin.statistics import create_statistics, finish_statistics
from python.quiet_protocol import Quiet

CASE = Case([(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (20.0, 0.0, 0.0)], duration_s=3.0)
Rows = list[list[str]]


class Counting(Quiet):
    """Tracks sent and received messages."""

    def initialize(self) -> None:
        self.provider.tracked_variables["heard"] = 0
        create_statistics(self, "comparison", 0.13)
        self.provider.schedule_timer("send", 0.0401 * (1 + self.provider.get_id()))

    def handle_timer(self, timer: str) -> None:
        self.provider.tracked_variables["sent"] = self.provider.tracked_variables.get("sent", 0) + 1
        self.provider.send_communication_command(BroadcastMessageCommand("hello"))
        self.provider.schedule_timer("send", self.provider.current_time() + 0.0371)

    def handle_packet(self, message: str) -> None:
        self.provider.tracked_variables["heard"] += 1

    def finish(self) -> None:
        finish_statistics(self)


def files_of(folder: Path) -> dict[str, Rows]:
    """Return the files that a run wrote there, without wall time."""
    files = {}
    for file in folder.iterdir():
        header, *rows = csv.reader(file.read_text().splitlines())
        wall = header.index("real_time") if "real_time" in header else len(header)
        files[file.name] = [header, *([*row[:wall], *row[wall + 1 :]] for row in rows)]
    return files


def test_the_same_callbacks_and_the_same_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    traces, files = [], []
    for mode in ("integrated", "prototype"):
        (tmp_path / mode).mkdir()
        monkeypatch.chdir(tmp_path / mode)
        traces.append(trace_case(mode, CASE, Counting))
        files.append(files_of(tmp_path / mode))
    assert_same(*traces)
    assert files[0].keys() == files[1].keys()
    assert len(files[0]) == 2 * len(CASE.positions)
    for name, (header, *rows) in files[0].items():
        header_too, *rows_too = files[1][name]
        assert header == header_too
        assert len(rows) > 20
        for row, row_too in zip(rows, rows_too, strict=True):
            assert [float(cell or -1) for cell in row] == pytest.approx(
                [float(cell or -1) for cell in row_too], rel=0, abs=1e-11
            )
