from io import StringIO

import pytest
from rich.console import Console

from gradysim.cli.count_tables import CountTables

COLUMNS = {
    kind: {"below sensitivity": 1_234_567, "receiver transmitting": number}
    for number, kind in enumerate(
        ["broadcast", "unicast", "unicast overheard", "ack", "ack overheard", "rts"]
    )
}


def printed(columns, width):
    text = StringIO()
    Console(file=text, width=width).print(CountTables("fate", columns))
    return text.getvalue()


def test_rows_columns_and_sums():
    text = printed({"one": {"a": 1, "b": 2000}, "two words": {"b": 3}}, width=80)
    assert [line.split() for line in text.splitlines() if line.strip() and "─" not in line] == [
        ["two"],
        ["fate", "one", "words"],
        ["a", "1", "0"],
        ["b", "2,000", "3"],
        ["sum", "2,001", "3"],
    ]


@pytest.mark.parametrize("width", [50, 80, 200])
def test_no_digit_is_lost_in_a_narrow_console(width):
    text = printed(COLUMNS, width)
    assert text.count("1,234,567") == len(COLUMNS) + 1  # the sum of the first column is the same
    assert "…" not in text


def test_there_is_one_table_where_there_is_room():
    lines = [line.split() for line in printed(COLUMNS, 200).splitlines()]
    assert ["receiver", "transmitting", "0", "1", "2", "3", "4", "5"] in lines
