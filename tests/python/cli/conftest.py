"""A directory with protocols and an .ini file, and the command in it."""

from functools import partial
from pathlib import Path

import pytest

from python.cli.command import INI, PROTOCOL, Gradysim, call_gradysim


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "protocol.py").write_text(PROTOCOL, encoding="utf-8")
    (tmp_path / "chatty.py").write_text(PROTOCOL + "print('printed by a module')", encoding="utf-8")
    (tmp_path / "test.ini").write_text(INI, encoding="utf-8")
    return tmp_path


@pytest.fixture
def gradysim(folder: Path) -> Gradysim:
    """`gradysim(*arguments)` calls the command in the directory with test.ini."""

    return partial(call_gradysim, folder)
