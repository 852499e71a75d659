import errno
import os
from pathlib import Path

import pytest

from gradysim.results.durable import bytes_in, finished_name, replacing, unfinished_file


def write(path: Path, text: str) -> None:
    with replacing(path) as unfinished:
        unfinished.write_text(text)


def test_a_file_is_on_the_disk_before_it_has_its_name_and_its_name_after_that(tmp_path, monkeypatch):
    calls = []
    replace, fsync = Path.replace, os.fsync

    def noted_replace(path, target):
        calls.append(f"replace {target.name}")
        return replace(path, target)

    def noted_fsync(descriptor):
        calls.append(f"fsync {Path(os.readlink(f'/proc/self/fd/{descriptor}')).name}")
        fsync(descriptor)

    monkeypatch.setattr(Path, "replace", noted_replace)
    monkeypatch.setattr(os, "fsync", noted_fsync)
    write(tmp_path / "out" / "a.json", "new")
    file_first = [f"fsync a.json.{os.getpid()}", "replace a.json", "fsync out"]
    assert calls == [f"fsync {tmp_path.name}", *file_first]
    assert (tmp_path / "out" / "a.json").read_text() == "new"


@pytest.mark.parametrize("code", [errno.EINVAL, errno.ENOTSUP])
def test_a_file_system_may_be_unable_to_sync_directories(tmp_path, monkeypatch, code):
    def fsync(descriptor):
        if os.path.isdir(f"/proc/self/fd/{descriptor}"):
            raise OSError(code, "no directories")

    monkeypatch.setattr(os, "fsync", fsync)
    write(tmp_path / "a.json", "new")
    assert (tmp_path / "a.json").read_text() == "new"


@pytest.mark.parametrize("failure", [KeyboardInterrupt(), OSError(errno.ENOSPC, "no space left")])
def test_what_fails_leaves_the_earlier_file_alone(tmp_path, failure):
    path = tmp_path / "a.json"
    path.write_text("old")

    def fail_half_way() -> None:
        with replacing(path) as unfinished:
            unfinished.write_text("half")
            raise failure

    with pytest.raises(type(failure)) as raised:
        fail_half_way()
    assert [file.name for file in tmp_path.iterdir()] == ["a.json"]
    assert path.read_text() == "old"
    if isinstance(failure, OSError):
        assert raised.value.filename == str(path)


def test_what_a_killed_process_of_the_same_id_left_is_no_part_of_the_new_file(tmp_path):
    unfinished_file(tmp_path / "a.sca").write_text("left over")
    with replacing(tmp_path / "a.sca") as unfinished:
        assert not unfinished.exists()
        unfinished.touch()


@pytest.mark.parametrize("name", ["A-#0.integrated.json", "A-#1.prototype.sca", "A-#1-uavs[0]-wlan1.pcap"])
def test_unfinished_files_are_known_by_their_names(name):
    assert finished_name(unfinished_file(Path(name)).name) == name


@pytest.mark.parametrize("name", ["A-#0.integrated.json", "notes.1234", "a.json.old", ".gradysim.lock"])
def test_other_files_are_not_unfinished(name):
    assert finished_name(name) is None


def test_a_failed_read_names_the_file(tmp_path, monkeypatch):
    def read(_):
        raise OSError(errno.EIO, "spoilt")  # as of a read, which knows a descriptor only

    monkeypatch.setattr(Path, "read_bytes", read)
    with pytest.raises(OSError, match="spoilt") as raised:
        bytes_in(tmp_path / "a.json")
    assert raised.value.filename == str(tmp_path / "a.json")
