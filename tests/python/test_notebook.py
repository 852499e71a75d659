from gradysim.notebook import MOST_COLUMNS, MOST_ROWS, html_table

CAPTION = "<caption style='text-align: left; white-space: nowrap'>"


def test_a_table_has_a_caption_headings_and_escaped_cells() -> None:
    assert html_table("a & b", ("name", "n"), [("<x>", 1), ("y", 2)]).splitlines() == [
        f"<table>{CAPTION}a &amp; b</caption>",
        "<tr><th>name</th><th>n</th></tr>",
        "<tr><td>&lt;x&gt;</td><td>1</td></tr>",
        "<tr><td>y</td><td>2</td></tr>",
        "</table>",
    ]


def test_a_column_of_equal_values_may_become_part_of_the_caption() -> None:
    rows = [("prototype", 1), ("prototype", 2)]
    table = html_table("runs", ("mode", "n"), rows, in_caption=["mode", "n"])
    assert f"{CAPTION}runs, mode prototype</caption>" in table
    assert "<tr><th>n</th></tr>" in table


def test_a_long_table_counts_the_rows_that_it_leaves_out() -> None:
    table = html_table("runs", ("n",), [(number,) for number in range(MOST_ROWS + 1000)])
    assert table.count("<td>") == MOST_ROWS
    assert " 1,000 " in table


def test_a_wide_table_counts_the_columns_that_it_leaves_out() -> None:
    table = html_table("run", ["n"] * (MOST_COLUMNS + 1000), [range(MOST_COLUMNS + 1000)])
    assert table.count("<td>") == table.count("<th>") == MOST_COLUMNS
    assert " 1,000 " in table


def test_a_long_cell_is_cut_off() -> None:
    assert len(html_table("run", ("text",), [("x" * 100_000,)])) < 1000


def test_no_rows_are_an_empty_table() -> None:
    assert html_table("no runs", ("n",), []) == f"<table>{CAPTION}no runs</caption>\n</table>"
