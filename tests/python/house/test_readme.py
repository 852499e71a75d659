"""What README.md shows to a newcomer is what happens."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.config import load_scenarios


@pytest.fixture
def first_protocol(root: Path, tmp_path: Path) -> Path:
    """The two files of the first protocol, as a reader would save them; returns the .ini file."""
    readme = (root / "README.md").read_text()
    for language, name in [("python", "hello.py"), ("ini", "hello.ini")]:
        block = re.search(rf"^```{language}\n(.*?)^```", readme, re.MULTILINE | re.DOTALL)
        assert block is not None
        (tmp_path / name).write_text(block[1])
    return tmp_path / "hello.ini"


def heard(run: Callable[..., Any], file: Path, config: str) -> list[int]:
    """How many greetings each node heard."""
    result = run(load_scenarios(file, config)[0])
    return [node.tracked_variables["heard"] for node in result.nodes]


def test_in_prototype_mode_everybody_hears_all_others(first_protocol: Path) -> None:
    from gradysim.prototype.run import run

    assert heard(run, first_protocol, "General") == [180] * 4


def test_in_integrated_mode_nobody_hears_anything(first_protocol: Path) -> None:
    pytest.importorskip("gradysim._netsim")
    from gradysim.integrated.run import run

    assert heard(run, first_protocol, "General") == [0] * 4


def test_jitter_makes_them_heard(first_protocol: Path) -> None:
    pytest.importorskip("gradysim._netsim")
    from gradysim.integrated.run import run

    assert min(heard(run, first_protocol, "Jittered")) > 150


def test_its_commands_are_those_of_make(root: Path) -> None:
    targets = set(re.findall(r"^([a-z-]+):.*##", (root / "Makefile").read_text(), re.MULTILINE))
    for document in ["README.md", "CONTRIBUTING.md"]:
        named = set(re.findall(r"(?:^|`)make ([a-z-]+)", (root / document).read_text(), re.MULTILINE))
        assert named <= targets, document


def test_contributing_lists_every_command(root: Path) -> None:
    targets = set(re.findall(r"^([a-z-]+):.*##", (root / "Makefile").read_text(), re.MULTILINE))
    table = set(re.findall(r"^\| `make ([a-z-]+)`", (root / "CONTRIBUTING.md").read_text(), re.MULTILINE))
    assert targets - table == {"help"}
