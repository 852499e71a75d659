from io import StringIO

import pytest
from rich.console import Console

from gradysim.cli.means import means_table, write_means
from gradysim.results.means import Mean

FAST = Mean("Study", "integrated", {"jitter": 10, "0": "a"}, "uavs[*] heard", 10, 1234.5, 1234.25, 1234.75)
SLOW = Mean("Study", "prototype", {"jitter": 20}, "uavs[*] heard", 1, 2.0, None, None)

NONE = Mean("Study", "integrated", {"jitter": 30}, "uavs[*] heard", 0, None, None, None, "3 inf of 3")


def printed(*means: Mean) -> list[list[str]]:
    text = StringIO()
    Console(file=text, width=120).print(means_table(means))
    return [line.split() for line in text.getvalue().splitlines()]


def test_what_all_have_in_common_is_the_title() -> None:
    title, heading, _, row = printed(FAST)
    assert title == ["Study,", "integrated", "mode"]
    assert heading == ["$jitter", "$0", "quantity", "runs", "mean", "±", "(95", "%)"]
    assert row == ["10", "a", "uavs[*]", "heard", "10", "1234.5", "0.25"]


def test_both_ends_of_an_interval_are_told_if_the_mean_is_not_in_its_middle() -> None:
    *_, row = printed(Mean("Study", "integrated", {}, "uavs[*] found", 10, 0.9, 0.55498, 0.99747))
    assert row == ["uavs[*]", "found", "10", "0.9", "[0.555,", "0.997]"]


def test_modes_that_differ_are_a_column() -> None:
    title, heading, _, *rows = printed(FAST, SLOW)
    assert title == ["Study"]
    assert heading[:2] == ["mode", "$jitter"]
    assert rows[1] == ["prototype", "20", "uavs[*]", "heard", "1", "2"]


def test_what_is_left_out_is_a_column_where_something_is() -> None:
    _, heading, _, first, second = printed(FAST, NONE)
    assert heading[-2:] == ["left", "out"]
    assert first[-1] == "0.25"
    assert second == ["30", "uavs[*]", "heard", "0", "3", "inf", "of", "3"]


@pytest.mark.parametrize("name", ["delay[s]", "from[uav]", "a[/]b", ":smile:"])
def test_names_and_values_are_no_markup(name: str) -> None:
    title, heading, _, row = printed(Mean(name, "integrated", {name: name}, name, 1, 2.0, None, None, name))
    assert title == [f"{name},", "integrated", "mode"]
    assert heading[0] == f"${name}"
    assert row == [name, name, "1", "2", name]
    rows = printed(Mean(name, "integrated", {}, "heard", 1, 2.0, None, None), FAST)[3:]
    assert rows[0] == [name, "heard", "1", "2"]


def test_csv_has_all_digits() -> None:
    text = StringIO()
    write_means([FAST, SLOW, NONE], text)
    assert text.getvalue().splitlines() == [
        "config,mode,jitter,0,quantity,runs,mean,low,high,left_out",
        "Study,integrated,10,a,uavs[*] heard,10,1234.5,1234.25,1234.75,",
        "Study,prototype,20,,uavs[*] heard,1,2.0,,,",
        "Study,integrated,30,,uavs[*] heard,0,,,,3 inf of 3",
    ]


def test_lines_of_csv_end_as_other_tools_expect_them() -> None:
    text = StringIO(newline="")
    write_means([SLOW], text)
    assert text.getvalue().count("\n") == 2
    assert "\r" not in text.getvalue()


def test_a_variable_called_as_another_column_has_a_heading_of_its_own_in_csv() -> None:
    text = StringIO()
    write_means(
        [Mean("Study", "integrated", {"mode": "b", "x": 1}, "uavs[*] heard", 1, 2.0, None, None)], text
    )
    assert text.getvalue().splitlines()[0] == "config,mode,$mode,x,quantity,runs,mean,low,high,left_out"


def test_a_narrow_table_loses_no_letter() -> None:
    text = StringIO()
    long = Mean("Study", "integrated", {"fading": "Free" * 8}, "uavs[*] heard", 1, 2.0, None, None)
    Console(file=text, width=40).print(means_table([long]))
    assert "…" not in text.getvalue()
