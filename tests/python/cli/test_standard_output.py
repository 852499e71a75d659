import errno
import io
import os
import sys

import pytest

from gradysim.cli.standard_output import is_about_output, named_output


def test_what_is_written_arrives_and_no_letter_is_an_error(tmp_path):
    with (tmp_path / "file").open("w", encoding="ascii") as file:
        named = named_output(file)
        print("5 µW", file=named, flush=True)
    assert (tmp_path / "file").read_text() == "5 \\xb5W\n"


def test_what_was_chosen_for_letters_that_it_lacks_stays_so(tmp_path):
    with (tmp_path / "file").open("w", encoding="ascii", errors="replace") as file:
        print("5 µW", file=named_output(file), flush=True)
    assert (tmp_path / "file").read_text() == "5 ?W\n"


def test_what_was_written_before_comes_first(tmp_path):
    with (tmp_path / "file").open("w") as file:
        print("before", file=file)
        print("after", file=named_output(file), flush=True)
    assert (tmp_path / "file").read_text() == "before\nafter\n"


@pytest.mark.parametrize("buffering", [0, -1], ids=["unbuffered", "buffered"])
def test_an_error_says_what_it_is_about(buffering):
    theirs, ours = os.pipe()
    os.close(theirs)
    with open(ours, "wb", buffering) as file:
        named = named_output(io.TextIOWrapper(file, write_through=True))
        with pytest.raises(BrokenPipeError, match=r"'standard output'$") as raised:
            print("text", file=named, flush=True)
        assert is_about_output(raised.value)
        os.dup2(os.open(os.devnull, os.O_WRONLY), ours)  # for what is still in the buffer


def test_other_errors_are_not_about_it():
    assert not is_about_output(OSError(errno.ENOSPC, "no space left"))
    assert not is_about_output(OSError(errno.ENOSPC, "no space left", "other"))
    assert not is_about_output(None)


def test_what_is_no_file_stays_as_it_is():
    for stream in (io.StringIO(), io.TextIOWrapper(io.BytesIO()), sys.stdin):
        assert named_output(stream) is stream
