import io
import sys

import pytest

from gradysim.scripting.progress import progress_bar


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_a_terminal_shows_the_bar_until_its_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(sys, "stderr", Terminal())
    with progress_bar("Study", "runs") as update:
        update(3, 20)
    assert "3 of 20 " in sys.stderr.getvalue()  # type: ignore[attr-defined]


def test_a_file_gets_no_bar(capsys: pytest.CaptureFixture[str]) -> None:
    with progress_bar("Study", "runs") as update:
        update(3, 20)
    assert capsys.readouterr() == ("", "")
