"""`gradysim keys`: the keys of .ini files."""

import sys
from collections.abc import Iterable
from typing import Annotated

from cyclopts import Parameter
from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.text import Text

from gradysim.cli.docs import with_commands, with_links
from gradysim.cli.errors import MISTAKE, OK
from gradysim.scenario.key_list import KeySection, key_meant, key_sections, matching
from gradysim.scenario.schema.native_protocols import native_protocols

_PATTERN = "Part of a key, of its values or of its meaning; or a pattern such as `*.power`."


_INDENT = 4

HEADINGS = ("key", "unit or value", "default", "meaning")

INTRODUCTION = """# Keys of .ini files

The keys that an `.ini` file may set. `gradysim keys` prints this page. `gradysim keys ardupilot` prints the
keys that contain this word in their name, values or meaning. `gradysim keys "*.power"` prints those with this
ending.

- `nodes` stands for the name of a group, `*` for any index.
- Values may have other units of the same dimension: a power in `mW` or `dBm`, a time in `ms` or `h`.
- If two lines match, the first one is in force. Write `*.uavs[0].mobility.speed` above
  `*.uavs[*].mobility.speed`. `gradysim run` warns of a line that has no effect because of a line above it.
- A list of values, `${10ms, 50ms}`, makes one run for each (docs/reference/studies.md).
- Values may be expressions, `50m * parentIndex()`, or random, `uniform(0m, 1km)` (docs/reference/values.md).
- A section may have `extends = NAME` and `abstract = true`. `include FILE` inserts another file, which
  must be a regular file, or a profile of the package (docs/how-to/behave-as-ns3-or-inet.md). A scenario has
  at most 64 MiB, in at most 1,000 files.
- Options that only OMNeT++ has are ignored: those for running and showing a simulation (`cmdenv-*`,
  `qtenv-*`, `ned-path`, `*.visualizer.**`), and those for recording (`result-dir`, `**.vector-recording`).
  Of `network` only the name is used.

A key that matches no parameter is an error. Nothing reads a line for a model that is not chosen, such as
`pathLoss.sigma` with `FreeSpacePathLoss`. `gradysim run` warns of it. It does not warn if at least one node
reads the line, if `typename = ""` turns the model off, or in prototype mode.

`gradysim keys --markdown` writes this page."""


def list_keys(
    pattern: Annotated[str, Parameter(name="PATTERN", help=_PATTERN)] = "",
    /,
    *,
    markdown: Annotated[bool, Parameter(negative="", help="A page in Markdown.")] = False,
) -> int:
    """Carry out `gradysim keys`, and return the exit code."""
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

        console().print(rich_list(sections))
    else:
        print(plain_text(sections), end="")
    return OK


def rich_list(sections: Iterable[KeySection]) -> RenderableType:
    """Return a paragraph per key. Names are not broken."""
    parts: list[RenderableType] = []
    for section in sections:
        parts += [Text(section.title, style="bold underline"), Text()]
        for row in section.rows:
            default = f"; default: {row.default}" if row.default else ""
            parts.append(Text(row.key, style="bold", no_wrap=True, overflow="ignore"))
            meaning = with_commands(row.meaning)
            parts.append(Padding(Text(f"{row.unit}{default}\n{meaning}"), (0, 0, 1, _INDENT)))
    return Group(*parts)


def plain_text(sections: Iterable[KeySection]) -> str:
    """Return one line per key, with four columns separated by tabs, for other programs."""
    rows = [row for section in sections for row in section.rows]
    return "".join(f"{row.key}\t{row.unit}\t{row.default}\t{with_commands(row.meaning)}\n" for row in rows)


def markdown_page(sections: Iterable[KeySection]) -> str:
    """Return the page docs/reference/keys.md."""
    parts = [with_links(INTRODUCTION)]
    for section in sections:
        lines = [f"| {' | '.join(HEADINGS)} |", "|---|---|---|---|"]
        lines += [
            f"| `{row.key}` | {row.unit} | {_code(row.default)} | {with_links(row.meaning)} |"
            for row in section.rows
        ]
        parts += [f"## {section.title}", "\n".join(lines)]
    return "\n\n".join(parts) + "\n"


def _code(default: str) -> str:
    return default if not default or (" " in default and '"' not in default) else f"`{default}`"
