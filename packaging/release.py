"""Check that the main branch can be released, and tag it: `make release VERSION=1.0.0`.

Two commands, since make builds and tests the wheels between them: `release.py check 1.0.0` and
`release.py tag 1.0.0`. The other tests run in CI, on the commit of the tag, before anything is published. A
pre-release, such as 1.0.0rc1, has the notes that the release has so far.
"""

import datetime
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

VERSION = re.compile(r"(\d+\.\d+\.\d+)((?:a|b|rc)\d+)?")
"""A release and the suffix of a pre-release, in the normal form of PEP 440."""

PUBLISH = """\
The tag v{version} is in this clone only. Publish it:

  git push origin main v{version}

The workflow `wheels` then publishes the wheels, once the tests of the tagged commit have passed.
"""

NEXT = """
To begin the next version, raise `fallback_version` in pyproject.toml and open CHANGELOG.md with
"## Unreleased (VERSION)".
"""


def git(*arguments: str, given: str | None = None) -> str:
    """Return what a command of git prints."""
    done = subprocess.run(["git", *arguments], input=given, check=True, stdout=subprocess.PIPE, text=True)
    return done.stdout.strip()


def first_section() -> tuple[str, str]:
    """Return the heading of the first section of the changelog, and the notes under it."""
    _, section = Path("CHANGELOG.md").read_text().split("\n## ", 2)[:2]
    heading, _, notes = section.partition("\n")
    return heading.strip(), notes.strip()


def is_dated(heading: str, version: str) -> bool:
    """Return whether a heading is that of a release, as `1.0.0 (2026-11-30)`."""
    try:
        date = datetime.date.fromisoformat(heading[-11:-1])
    except ValueError:
        return False
    return heading == f"{version} ({date})"


def obstacles(version: str) -> Iterator[str]:
    """Yield what keeps the release back."""
    if (parts := VERSION.fullmatch(version)) is None:
        yield f"expected a version such as 1.0.0 or 1.0.0rc1, got `{version}`"
        return
    release, is_early = parts[1], parts[2] is not None
    if (branch := git("branch", "--show-current")) != "main":
        yield f"expected the branch `main`, got `{branch}`"
    if git("status", "--porcelain"):
        yield "there are changes that are not committed: `git status` lists them"
    if git("tag", "--list", f"v{version}"):
        yield f"the tag v{version} exists"
    fallback = tomllib.loads(Path("pyproject.toml").read_text())["tool"]["vcs-versioning"]["fallback_version"]
    if fallback != f"{release}.dev0":
        yield f"pyproject.toml: expected fallback_version `{release}.dev0`, got `{fallback}`"
    heading, notes = first_section()
    expected = f"Unreleased ({release})" if is_early else f"{version} ({datetime.date.today()})"
    if heading != expected and (is_early or not is_dated(heading, version)):
        yield f"CHANGELOG.md: expected the heading `## {expected}`, got `## {heading}`"
    elif not notes:
        yield f"CHANGELOG.md: nothing under `## {heading}`"
    if is_dated(heading, version):
        for line in (f"version: {version}", f"date-released: {heading[-11:-1]}"):
            if line not in Path("CITATION.cff").read_text().splitlines():
                yield f"CITATION.cff: expected `{line}`"


def check(version: str) -> None:
    """Exit with all that keeps a release back."""
    if found := list(obstacles(version)):
        sys.exit("\n".join(found))


def tag(version: str) -> None:
    """Write the tag, with the notes of the release as its message."""
    check(version)
    heading, notes = first_section()
    # Verbatim: git takes headings for comments.
    message = f"gradysim {version}\n\n{notes}\n"
    git("tag", "--annotate", "--cleanup=verbatim", "--file=-", f"v{version}", given=message)
    print(PUBLISH.format(version=version), NEXT if is_dated(heading, version) else "", sep="", end="")


if __name__ == "__main__":
    {"check": check, "tag": tag}[sys.argv[1]](sys.argv[2])
