"""The output in docs/how-to/run-in-a-script.md is correct."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

import gradysim

GUIDE = "docs/how-to/run-in-a-script.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.fixture
def shown(code_blocks: CodeBlocks) -> dict[str, Any]:
    """Return the functions defined on the page."""
    names: dict[str, Any] = {}
    exec("\n".join(code_blocks(GUIDE, "python")), names)
    return names


@pytest.fixture
def file(swarm: Path) -> str:
    return str(swarm / "swarm/swarm.ini")


def test_its_commands_print_the_rows_that_are_shown(
    code_blocks: CodeBlocks,
    shell: Callable[[str, Path], str],
    saved: Callable[..., Path],
    shows: Callable[..., None],
) -> None:
    (commands,) = code_blocks(GUIDE, "sh")
    shows(GUIDE, shell(commands, saved(GUIDE, python="compare.py")), part=True)


def test_a_study_gives_the_means_of_its_runs(
    shown: dict[str, Any], file: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(Path(file).parent)
    found = shown["means_of_study"](file)
    study = gradysim.load(file, "Study")
    assert found.keys() == {2, 5, 10, 20}
    first = [gradysim.run(scenario) for scenario in study if scenario.iterations["vehicles"] == "5"]
    heard = [node.tracked_variables["heard"] for run in first for node in run.nodes if node.name == "station"]
    assert found[5] == pytest.approx(sum(heard) / len(heard))
    assert shown["means_of_study"](file) == found, "the second call resumes"


def test_an_interrupt_leaves_the_results_so_far(shown: dict[str, Any], file: str) -> None:
    (line,) = [line for line in Path(file).read_text().splitlines() if "protocols.py:Vehicle" in line]
    stopped = line.replace("[*]", "[0]").replace("protocols.py:Vehicle", "stopped.py:Stopped")
    Path(file).write_text(Path(file).read_text().replace(line, f"{stopped}\n{line}"))
    (Path(file).parent / "stopped.py").write_text(
        "from protocols import Vehicle\n\n\n"
        "class Stopped(Vehicle):\n"
        "    def handle_timer(self, timer):\n"
        "        if self.reports == 9:\n"
        "            raise KeyboardInterrupt\n"
        "        super().handle_timer(timer)\n"
    )
    result = shown["partial_result"](file)
    assert result.interrupted
    assert result.sim_time_s == 10
    assert result.nodes[0].tracked_variables["reports"] == 9
