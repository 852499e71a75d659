import math
import threading
from io import StringIO

import pytest
from rich.console import Console

from gradysim.cli.progress import RunProgress, text_of_speed


def shown(limit_s, *times, width=120):
    text = StringIO()
    console = Console(file=text, force_terminal=True, width=width, color_system=None)
    with RunProgress(console, "ZigZag5 run [0]", limit_s) as bar:
        for time in times:
            bar.update(time)
    return text.getvalue()


def test_title_and_simulated_time():
    text = shown(7200.0, 120.0)
    assert "ZigZag5 run [0]" in text
    assert "120 of 7,200 s" in text


def test_remaining_time_is_unknown_at_first():
    assert "-:--:--" in shown(10.0, 0.0)


def test_it_is_drawn_anew_at_each_update():
    text = StringIO()
    with RunProgress(Console(file=text, force_terminal=True, width=120), "General run 0", 7200.0) as bar:
        bar.update(120.0)
        assert "120 of 7,200 s" in text.getvalue()


@pytest.mark.parametrize(
    ("speed", "shown"),
    [
        (None, ""),
        (0.51234, "0.512"),
        (585.4, "585"),
        (999.6, "1,000"),
        (1234.5, "1,234"),
        (12_345.6, "12,346"),
    ],
)
def test_a_speed_has_three_digits_or_all_before_the_point(speed, shown):
    assert text_of_speed(speed) == (shown and f"{shown} x real time")


def test_speed_is_shown_once_it_is_known():
    assert " x " in shown(10.0, 1.0, 2.0, 3.0)


@pytest.mark.parametrize("limit_s", [math.inf])
def test_a_run_without_a_limit(limit_s):
    text = shown(limit_s, 5.0)
    assert "5 s" in text
    assert " of " not in text


def test_all_of_it_fits_into_one_line_of_a_narrow_terminal():
    text = shown(28_800.0, 1.0, 27_000.0, 28_000.0, width=80)
    assert text.count("\n") == 1
    assert "28,000 of 28,800 s" in text
    assert "…" not in text


def test_there_is_no_thread_beside_the_simulation():
    console = Console(file=StringIO(), force_terminal=True)
    before = threading.active_count()
    with RunProgress(console, "General run 0", 10.0):
        assert threading.active_count() == before


def test_the_bar_is_gone_at_the_end():
    assert shown(10.0, 10.0).endswith("\x1b[2K")
