"""`gradysim keys`: the keys of .ini files."""

import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from gradysim.cli.exit_code import MISTAKE, OK

if TYPE_CHECKING:
    from rich.console import RenderableType

    from gradysim.scenario.key_list import KeySection

_PATTERN = "Part of a key, of its values or of its meaning; or a key with *."


HEADINGS = ("key", "unit or value", "default", "meaning")

INTRODUCTION = """# Keys of .ini files

All that an `.ini` file may say; `gradysim keys` prints this page, `gradysim keys ardupilot` the keys in whose
name, values or meaning that stands, in any case, and `gradysim keys "*.power"` those whose name ends so.
`nodes` stands for the name of a group, `*` for any index. Values in other units of the same dimension are
understood too: a power in `mW` or `dBm`, a time in `ms` or `h`.
Of two lines that fit, the first one is in force: write `*.uavs[0].mobility.speed` above
`*.uavs[*].mobility.speed`. `gradysim run` warns of a line that another one above it in the same section of
the same file deprives of any effect. A list of values, `${10ms, 50ms}`, makes runs of each
(docs/guides/results.md). Values may be worked out, `50m * parentIndex()`, and drawn, `uniform(0m, 1km)`, for
each node its own (docs/guides/values.md). A section may also say `extends = NAME` and `abstract = true`, and
`include FILE` puts another file in the place of that line. What only OMNeT++ needs is
ignored: `network` but for its name, how it runs and shows a simulation (`cmdenv-*`, `qtenv-*`, `ned-path`,
`*.visualizer.**` and so on), and what it records where (`result-dir`, `**.vector-recording` and so on).

A key that matches no parameter is an error. A line for a model that is not chosen (`pathLoss.sigma` with
`FreeSpacePathLoss`) is none, but `gradysim run` says on the error output that nothing reads it, and what
would. It says nothing of a line that at least one node reads, nor of one whose model is turned off in so many
words, by `typename = ""`, nor in prototype mode, which has no such models.

This page is made by `gradysim keys --markdown`."""


def list_keys(
    pattern: Annotated[str, Parameter(name="PATTERN", help=_PATTERN)] = "",
    /,
    *,
    markdown: Annotated[bool, Parameter(negative="", help="A page in Markdown.")] = False,
) -> int:
    """List the keys of .ini files: unit, default, meaning."""
    from gradysim.scenario.key_list import key_meant, key_sections, matching
    from gradysim.scenario.native_protocols import native_protocols

    try:
        natives = list(native_protocols().values())
    except ImportError:
        natives = []
        print("the engine is not installed: its own protocols are not listed", file=sys.stderr)
    everything = key_sections(natives)
    sections = matching(everything, pattern)
    if not sections:
        hint = key_meant(everything, pattern)
        print(
            f"no key, value or meaning contains {pattern!r}; `gradysim keys` lists all{hint}", file=sys.stderr
        )
        return MISTAKE
    if markdown:
        print(markdown_page(sections), end="")
    elif sys.stdout.isatty():
        from gradysim.cli.console import console

        console().print(rich_tables(sections))
    else:
        print(plain_text(sections), end="")
    return OK


def rich_tables(sections: "Iterable[KeySection]") -> "RenderableType":
    """Return a table per section."""
    from rich import box
    from rich.console import Group
    from rich.table import Table
    from rich.text import Text

    parts: list[RenderableType] = []
    for section in sections:
        table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
        for heading, ratio in zip(HEADINGS, (6, 3, 3, 5), strict=True):
            table.add_column(heading, overflow="fold", ratio=ratio)
        for row in section.rows:
            table.add_row(*map(Text, (row.key, row.unit, row.default, row.meaning)))
        parts += [Text(section.title, style="bold"), table, Text()]
    return Group(*parts)


def plain_text(sections: "Iterable[KeySection]") -> str:
    """Return one line per key, its four columns separated by tabs, for other programs."""
    rows = [row for section in sections for row in section.rows]
    return "".join(f"{row.key}\t{row.unit}\t{row.default}\t{row.meaning}\n" for row in rows)


def markdown_page(sections: "Iterable[KeySection]") -> str:
    """Return the page docs/guides/keys.md."""
    parts = [INTRODUCTION]
    for section in sections:
        lines = [f"| {' | '.join(HEADINGS)} |", "|---|---|---|---|"]
        lines += [
            f"| `{row.key}` | {row.unit} | {_code(row.default)} | {row.meaning} |" for row in section.rows
        ]
        parts += [f"## {section.title}", "\n".join(lines)]
    return "\n\n".join(parts) + "\n"


def _code(default: str) -> str:
    return default if not default or (" " in default and '"' not in default) else f"`{default}`"
