"""The output in README.md is correct."""

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from python.viewing import watched

README = Path(__file__).parents[3] / "README.md"


@pytest.fixture
def folder(code_blocks: Callable[[str, str], list[str]], tmp_path: Path) -> Path:
    """Return a directory with the files of the first run."""
    for language, name in [("python", "hello.py"), ("ini", "hello.ini")]:
        (block,) = code_blocks("README.md", language)
        (tmp_path / name).write_text(block, encoding="utf-8")
    return tmp_path


def test_its_scenario_is_that_of_the_tutorial(code_blocks: Callable[[str, str], list[str]]) -> None:
    assert code_blocks("README.md", "ini") == code_blocks("docs/tutorial/1-hello.md", "ini")


def test_its_commands_print_what_is_said(folder: Path, shell: Callable[..., str]) -> None:
    lines = re.findall(r"^(gradysim run .*?) +# .*, (\d+) %", README.read_text(), re.MULTILINE)
    assert len(lines) == 3
    for command, percent in lines:
        result = json.loads(shell(f"{command} --json --quiet", folder))
        broadcast = result["outcomes"]["frames"]["broadcast"]
        decided = sum(count for outcome, count in broadcast.items() if outcome != "in_air")
        assert broadcast["delivered"] / decided == int(percent) / 100


def test_it_shows_a_part_of_the_summary(
    folder: Path, shell: Callable[..., str], shows: Callable[..., None]
) -> None:
    shows("README.md", shell("gradysim run hello.ini", folder), part=True)


@pytest.mark.verify
def test_the_run_can_be_watched(folder: Path) -> None:
    (command,) = re.findall(r"^(gradysim view hello.ini) +# ", README.read_text(), re.MULTILINE)
    assert watched(command, folder)[0]["complete"]


def test_each_line_of_its_sh_snippets_is_of_a_kind_that_is_tested_here(
    code_blocks: Callable[[str, str], list[str]],
) -> None:
    lines = "".join(code_blocks("README.md", "sh")).splitlines()
    known = re.compile(r"gradysim run .* # .*, \d+ %.*|gradysim view hello.ini .*# .*|pip install \. +# .*")
    assert [line for line in lines if not known.fullmatch(line)] == []


def test_its_protocols_in_two_languages_do_the_same(root: Path, shell: Callable[..., str]) -> None:
    (command,) = re.findall(r"`(gradysim run \S+ --json)`", README.read_text())
    runs = [
        json.loads(shell(f"{command} --quiet -c {config}", root)) for config in ("Beacons200", "Python200")
    ]
    assert runs[0]["result_hash"] == runs[1]["result_hash"]


def test_its_links_lead_somewhere(root: Path) -> None:
    links = re.findall(r"\]\(([^)#]+)\)", README.read_text())
    assert [link for link in links if "://" not in link and not (root / link).exists()] == []


def test_its_commands_are_those_of_make(root: Path) -> None:
    targets = set(re.findall(r"^([a-z-]+):.*##", (root / "Makefile").read_text(), re.MULTILINE))
    for document in ["README.md", "CONTRIBUTING.md"]:
        named = set(re.findall(r"(?:^|`)make ([a-z-]+)", (root / document).read_text(), re.MULTILINE))
        assert named <= targets, document


def test_contributing_lists_every_command(root: Path) -> None:
    targets = set(re.findall(r"^([a-z-]+):.*##", (root / "Makefile").read_text(), re.MULTILINE))
    table = set(re.findall(r"^\| `make ([a-z-]+)`", (root / "CONTRIBUTING.md").read_text(), re.MULTILINE))
    assert targets - table == {"help"}
