from io import StringIO

from rich.console import Console

from gradysim.cli.keys import markdown_page, plain_text, rich_tables
from gradysim.scenario.key_list import KeyRow, KeySection

SECTIONS = [KeySection("Of nodes", (KeyRow("*.nodes[*].a", "m", "1m", "Length"),))]


def test_plain_text_is_a_line_per_key() -> None:
    assert plain_text(SECTIONS) == "*.nodes[*].a\tm\t1m\tLength\n"


def test_markdown_is_a_table_per_section() -> None:
    assert markdown_page(SECTIONS).endswith(
        "## Of nodes\n\n| key | unit or value | default | meaning |\n|---|---|---|---|\n"
        "| `*.nodes[*].a` | m | `1m` | Length |\n"
    )


def test_brackets_are_no_markup_on_a_terminal() -> None:
    console = Console(file=StringIO(), width=120)
    with console.capture() as shown:
        console.print(rich_tables(SECTIONS))
    assert "*.nodes[*].a" in shown.get()
