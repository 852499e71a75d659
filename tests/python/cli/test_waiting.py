import io
import threading
from itertools import count

import pytest

from gradysim.cli import progress as module
from gradysim.cli.progress import EVERY_S, FIRST_AFTER_S, tell_until, waiting


class EndsAfter:
    """Is set at the n-th wait, without taking time."""

    def __init__(self, times: int) -> None:
        self.left = times
        self.waits: list[float] = []

    def wait(self, timeout: float) -> bool:
        self.waits.append(timeout)
        self.left -= 1
        return self.left == 0


@pytest.fixture(autouse=True)
def clock(monkeypatch: pytest.MonkeyPatch) -> None:
    ticks = count()
    monkeypatch.setattr(module, "monotonic", lambda: float(next(ticks)))


def told(ended: EndsAfter) -> str:
    terminal = io.StringIO()
    tell_until(ended, "reading", terminal)
    return terminal.getvalue()


def test_what_is_done_soon_is_not_told() -> None:
    ended = EndsAfter(1)
    assert (told(ended), ended.waits) == ("", [FIRST_AFTER_S])


def test_what_takes_long_is_told_in_one_line_that_is_wiped_out() -> None:
    ended = EndsAfter(3)
    assert told(ended) == "\rreading, 1 s\rreading, 2 s\r            \r"
    assert ended.waits == [FIRST_AFTER_S, EVERY_S, EVERY_S]


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize(("shown", "terminal"), [(False, Terminal()), (True, io.StringIO())])
def test_only_terminals_are_told_and_only_on_demand(
    monkeypatch: pytest.MonkeyPatch, shown: bool, terminal: io.StringIO
) -> None:
    monkeypatch.setattr("sys.stderr", terminal)
    threads = threading.active_count()
    with waiting("reading", shown=shown):
        assert threading.active_count() == threads


def test_nothing_is_left_behind_when_it_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stderr", Terminal())
    threads = threading.active_count()
    with waiting("reading", shown=True):
        assert threading.active_count() == threads + 1
    with pytest.raises(RuntimeError, match="spoilt"), waiting("reading", shown=True):
        raise RuntimeError("spoilt")
    assert threading.active_count() == threads
