"""`gradysim keys`: the keys of .ini files."""

import sys
from typing import Annotated

from cyclopts import Parameter

from gradysim.cli.exit_code import MISTAKE, OK

_PATTERN = "Part of a key, of its values or of its meaning; or a key with *."


def list_keys(
    pattern: Annotated[str, Parameter(name="PATTERN", help=_PATTERN)] = "",
    /,
    *,
    markdown: Annotated[bool, Parameter(negative="", help="A page in Markdown.")] = False,
) -> int:
    """List the keys of .ini files: unit, default, meaning."""
    from gradysim.cli import key_table
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
        print(key_table.markdown(sections), end="")
    elif sys.stdout.isatty():
        from gradysim.cli.console import console

        console().print(key_table.rich_tables(sections))
    else:
        print(key_table.plain_text(sections), end="")
    return OK
