"""Check that the main branch can be released, and tag it: `make release VERSION=1.0.0`.

Two commands, since make runs the tests and builds the wheels between them: `release.py check 1.0.0` and
`release.py tag 1.0.0`.
"""

import datetime
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

NEXT = """\
The tag v{version} is in this clone only. Publish it:

  git push origin main v{version}

The workflow `wheels` then publishes the wheels. To begin the next version, raise `fallback_version` in
pyproject.toml and open CHANGELOG.md with "## Unreleased (VERSION)".
"""


def git(*arguments: str, given: str | None = None) -> str:
    """Return what a command of git prints."""
    done = subprocess.run(["git", *arguments], input=given, check=True, stdout=subprocess.PIPE, text=True)
    return done.stdout.strip()


def section(version: str) -> tuple[str, str] | None:
    """Return what follows the version in its heading of the changelog, and the notes under it."""
    changelog = Path("CHANGELOG.md").read_text()
    found = re.search(
        rf"^## {re.escape(version)}\b([^\n]*)\n(.*?)(?=^## |\Z)", changelog, re.MULTILINE | re.DOTALL
    )
    return (found[1].strip(), found[2].strip()) if found else None


def is_date(text: str) -> bool:
    """Return whether the end of a heading is a date, as `(2026-11-30)`."""
    try:
        return text == f"({datetime.date.fromisoformat(text[1:-1])})"
    except ValueError:
        return False


def obstacles(version: str) -> Iterator[str]:
    """Yield what keeps the release back."""
    if not re.fullmatch(r"\d+\.\d+\.\d+", version):
        yield f"expected a version such as 1.0.0, got `{version}`"
        return
    if (branch := git("branch", "--show-current")) != "main":
        yield f"expected the branch `main`, got `{branch}`"
    if git("status", "--porcelain"):
        yield "there are changes that are not committed: `git status` lists them"
    if git("tag", "--list", f"v{version}"):
        yield f"the tag v{version} exists"
    fallback = tomllib.loads(Path("pyproject.toml").read_text())["tool"]["vcs-versioning"]["fallback_version"]
    if fallback != f"{version}.dev0":
        yield f"pyproject.toml: expected fallback_version `{version}.dev0`, got `{fallback}`"
    heading = f"## {version} ({datetime.date.today()})"
    if (found := section(version)) is None:
        yield f"CHANGELOG.md: expected the heading `{heading}`"
    elif not is_date(found[0]):
        yield f"CHANGELOG.md: expected the heading `{heading}`, got `## {version} {found[0]}`"
    elif not found[1]:
        yield f"CHANGELOG.md: nothing under `## {version} {found[0]}`"


def check(version: str) -> str:
    """Return the notes of a release, or exit with all that keeps it back."""
    if found := list(obstacles(version)):
        sys.exit("\n".join(found))
    dated = section(version)
    assert dated is not None
    return dated[1]


def tag(version: str) -> None:
    """Write the tag, with the notes of the release as its message."""
    message = f"gradysim {version}\n\n{check(version)}\n"
    # Verbatim: git takes headings for comments.
    git("tag", "--annotate", "--cleanup=verbatim", "--file=-", f"v{version}", given=message)
    print(NEXT.format(version=version), end="")


if __name__ == "__main__":
    {"check": check, "tag": tag}[sys.argv[1]](sys.argv[2])
