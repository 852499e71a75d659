from io import StringIO

from rich.console import Console

from gradysim.cli.keys import markdown_page, plain_text, rich_list
from gradysim.scenario.key_list import KeyRow, KeySection, key_sections

SECTIONS = [KeySection("Of nodes", (KeyRow("*.nodes[*].a", "m", "1m", "Length"),))]


def test_plain_text_is_a_line_per_key() -> None:
    assert plain_text(SECTIONS) == "*.nodes[*].a\tm\t1m\tLength\n"


def test_markdown_is_a_table_per_section() -> None:
    assert markdown_page(SECTIONS).endswith(
        "## Of nodes\n\n| key | unit or value | default | meaning |\n|---|---|---|---|\n"
        "| `*.nodes[*].a` | m | `1m` | Length |\n"
    )


def shown(sections: list[KeySection], width: int) -> list[str]:
    console = Console(file=StringIO(), width=width)
    with console.capture() as captured:
        console.print(rich_list(sections))
    return captured.get().splitlines()


def test_brackets_are_no_markup_on_a_terminal() -> None:
    lines = shown(SECTIONS, 120)
    assert [line.rstrip() for line in lines if line.strip()] == [
        "Of nodes",
        "*.nodes[*].a",
        "    m; default: 1m",
        "    Length",
    ]


def test_no_key_is_broken_in_a_terminal_of_80_columns() -> None:
    sections = key_sections()
    lines = {line.rstrip() for line in shown(sections, 80)}
    assert {row.key for section in sections for row in section.rows} <= lines
