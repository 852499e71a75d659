"""Each test has its own directory, and leaves no process, thread or directory behind."""

import gc
import threading

import pytest

from python.sitl.ardupilot_mobility.flying import programs_in


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)


@pytest.fixture(autouse=True)
def _nothing_is_left_behind(tmp_path):
    threads = threading.active_count()
    yield
    gc.collect()
    assert list(tmp_path.glob("gradysim-sitl-*")) == []
    assert programs_in(tmp_path) == []
    assert threading.active_count() == threads


@pytest.fixture
def quick_answers(monkeypatch):
    monkeypatch.setattr("gradysim.sitl.vehicle._ANSWER_S", 0.2)
