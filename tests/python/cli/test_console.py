from io import StringIO

import pytest
from rich.table import Table

from gradysim.cli.console import console


class Terminal(StringIO):
    def isatty(self) -> bool:
        return True


def lines(output: StringIO) -> list[str]:
    table = Table.grid()
    table.add_row("a word " * 50)
    console(output).print(table)
    return output.getvalue().splitlines()


def test_a_row_of_a_table_is_one_line_of_a_file(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("COLUMNS", raising=False)
    assert len(lines(StringIO())) == 1


def test_a_terminal_has_the_width_it_has(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("COLUMNS", raising=False)
    assert len(lines(Terminal())) > 1


def test_a_width_that_is_said_holds_for_files_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "70")
    assert len(lines(StringIO())) == 5
