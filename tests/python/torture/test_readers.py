"""Corpora of readers: each kept file is read or refused. `test_short.py` changes them."""

import pytest

from python.torture.readers import READERS, check, corpus

FILES = [(name, *file) for name in READERS for file in corpus(name)]


@pytest.mark.parametrize(
    ("name", "file_name", "content"), FILES, ids=[f"{file[0]}-{file[1]}" for file in FILES]
)
def test_a_kept_file_is_read_or_refused(name, file_name, content, tmp_path):
    file = tmp_path / file_name
    file.write_bytes(content)
    refused = check(name, file)
    assert file_name.startswith("damaged-") or not refused
