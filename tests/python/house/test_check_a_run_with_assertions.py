"""What docs/how-to/check-a-run-with-assertions.md shows is what happens to its python and ini files."""

import importlib
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.scenario import load_scenarios
from gradysim.simulator.handler.assertion import FailedAssertionException

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/check-a-run-with-assertions.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.fixture
def folder(climbers: Callable[[str, str], Path]) -> Path:
    return climbers(GUIDE, "test_climbers.py")


@pytest.mark.verify
def test_the_checks_hold_in_both_modes(
    code_blocks: CodeBlocks, folder: Path, shell: Callable[[str, Path], str], shows: Callable[..., None]
) -> None:
    (command,) = code_blocks(GUIDE, "sh")
    shows(GUIDE, shell(command, folder), changing=True)


@pytest.mark.parametrize("mode", ["prototype", "integrated"])
def test_a_check_fails_with_the_message_of_the_guide(
    root: Path, code_blocks: CodeBlocks, folder: Path, imported: Callable[[Path], Any], mode: str
) -> None:
    shown = code_blocks(GUIDE, "text")[1].strip()
    (change,) = re.findall(r"With `(.*)` in `watch.ini`", (root / GUIDE).read_text())
    message = re.escape(shown)
    if mode == "integrated":  # other iterations, as the guide says
        message = re.sub(r"iteration=\d+", r"iteration=\\d+", message)
    page = imported(folder / "test_climbers.py")
    module: Any = importlib.import_module(f"gradysim.{mode}.run")
    (scenario,) = load_scenarios("watch.ini", overrides=[change])
    with pytest.raises(FailedAssertionException, match=f"^{message}$"):
        module.run(scenario, handlers=[page.AssertionHandler([page.below_the_ceiling])])


def test_a_protocol_that_is_loaded_twice_is_an_error(folder: Path, imported: Callable[[Path], Any]) -> None:
    ini = folder / "watch.ini"
    ini.write_text(ini.read_text().replace("climber:", "climber.py:"))
    page = imported(folder / "test_climbers.py")
    with pytest.raises(TypeError, match=r'loaded twice.* "climber:Climber"'):
        page.test_climbers(importlib.import_module("gradysim.integrated.run").run)


def test_its_types_hold(folder: Path, type_errors: Callable[[Path], str]) -> None:
    assert type_errors(folder / "test_climbers.py") == ""
