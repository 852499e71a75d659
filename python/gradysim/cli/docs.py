"""`gradysim docs`: the pages of the documentation, in the terminal."""

import os
import re
import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter
from rich.markdown import Markdown

from gradysim.cli.console import console
from gradysim.cli.errors import MISTAKE, OK
from gradysim.cli.examples import files_root
from gradysim.scenario.errors import did_you_mean

FOLDERS = ("tutorial", "how-to", "explanation", "reference")
"""Those of a wheel. The others are for contributors."""

_NAMED = re.compile(rf"docs/({'|'.join(FOLDERS)})/([\w-]+)\.md")
_FOR_THE_SITE = re.compile(
    r"^(?:\{[^\n]*\}|```\{\w[^\n]*\n.*?^```|!\[.*?\]\(.*?\)) *\n", re.MULTILINE | re.DOTALL
)
"""Attributes and directives of Sphinx, and pictures."""

_LINK = re.compile(r"\[([^\]]*)\]\([^)]*\)")

WordArgument = Annotated[
    str,
    Parameter(
        name="WORD", help="Name of a page, or a word in its title or text. Without it, all pages are listed."
    ),
]


def pages() -> dict[str, Path]:
    """Return {name: file} of all pages."""
    files = (file for folder in FOLDERS for file in sorted((files_root() / "docs" / folder).glob("*.md")))
    return {file.stem: file for file in files if file.stem != "index"}


def title_of(file: Path) -> str:
    """Return the first heading of a page."""
    with file.open(encoding="utf-8") as lines:
        return next((line[2:].strip() for line in lines if line.startswith("# ")), file.stem)


def with_commands(text: str) -> str:
    """Return a text that names pages, `docs/how-to/x.md`, with the command that shows each of them."""
    return _NAMED.sub(r"`gradysim docs \2`", text)


def with_links(text: str) -> str:
    """Return a text that names pages with links from a page of the reference."""
    return _NAMED.sub(r"[\2](../\1/\2.md)", text)


def show_docs(word: WordArgument = "", /) -> int:
    """Carry out `gradysim docs`, and return the exit code."""
    known = pages()
    found = _matching(known, word)
    if not found:
        hint = did_you_mean(word, known)
        print(f"no page has {word!r} in its title or text; `gradysim docs` lists all{hint}", file=sys.stderr)
        return MISTAKE
    if len(found) == 1 and word:
        _print_page(known[found[0]])
        return OK
    width = max(map(len, found))
    for name in found:
        print(f"{name:{width}}  {title_of(known[name])}")
    return OK


def _matching(known: dict[str, Path], word: str) -> list[str]:
    """Return the pages of that name, or else with the word in their title, or else in their text."""
    wanted = word.casefold().removesuffix(".md").rpartition("/")[2]
    if wanted in known:
        return [wanted]
    in_title = [name for name in known if wanted in f"{name} {title_of(known[name])}".casefold()]
    return in_title or [name for name in known if wanted in known[name].read_text("utf-8").casefold()]


def _print_page(file: Path) -> None:
    text = _LINK.sub(r"\1", _FOR_THE_SITE.sub("", file.read_text(encoding="utf-8")))
    if not sys.stdout.isatty():
        print(text, end="")
        return

    terminal = console()
    os.environ.setdefault("LESS", "-R")  # otherwise it shows the codes of colors
    with terminal.pager(styles=True):
        terminal.print(Markdown(text))
