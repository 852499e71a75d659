from hashlib import sha256
from pathlib import Path
from random import Random

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from gradysim.results.file_checksum import (
    LINE_BYTES,
    append_checksum,
    has_checksum,
    remove_checksum,
    verify_checksum,
)
from python.damage import PAGE, damaged

per_example = settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])


def with_checksum(directory: Path, content: bytes) -> Path:
    file = directory / "with.bin"
    file.unlink(missing_ok=True)  # a process verifies each state of a file once
    file.write_bytes(content)
    append_checksum(file)
    return file


@given(st.binary(max_size=200))
@per_example
def test_content_stays_in_front_of_it(tmp_path: Path, content: bytes) -> None:
    file = with_checksum(tmp_path, content)
    assert has_checksum(file)
    verify_checksum(file)
    assert file.read_bytes()[:-LINE_BYTES] == content
    remove_checksum(file)
    assert file.read_bytes() == content


@given(content=st.binary(max_size=200) | st.just(bytes(3 * PAGE)), random=st.randoms(use_true_random=False))
@per_example
def test_damage_is_noticed(tmp_path: Path, content: bytes, random: Random) -> None:
    found = with_checksum(tmp_path, content).read_bytes()
    file = tmp_path / "damaged.bin"
    file.unlink(missing_ok=True)
    file.write_bytes(damaged(found, random))
    with pytest.raises(ValueError, match="checksum"):
        verify_checksum(file)


def test_it_is_the_hash_that_other_programs_compute(tmp_path: Path) -> None:
    found = with_checksum(tmp_path, b"\0binary" * 1000).read_bytes()
    assert found[-90:].decode() == f"gradysim, SHA-256 above: {sha256(found[:-91]).hexdigest()}\n"


def test_another_file_is_an_error(tmp_path: Path) -> None:
    file = tmp_path / "other.bin"
    file.write_bytes(b"other")
    assert not has_checksum(file)
    with pytest.raises(ValueError, match="checksum"):
        verify_checksum(file)


def test_a_changed_file_is_verified_again(tmp_path: Path) -> None:
    file = with_checksum(tmp_path, b"content")
    verify_checksum(file)
    file.write_bytes(file.read_bytes() + b"\n")
    with pytest.raises(ValueError, match="checksum"):
        verify_checksum(file)
