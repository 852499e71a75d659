"""The commands of the tutorial, in order, print the output that its pages show."""

import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from difflib import SequenceMatcher
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")
pytest.importorskip("matplotlib")

from gradysim.integrated.calibration import calibrate
from gradysim.scenario import load_scenarios
from gradysim.scenario.schema.keys import COMMUNICATION_MEDIUM_KEYS
from python.viewing import visited, watched

ROOT = Path(__file__).parents[3]
PAGES = [
    ROOT / page
    for page in (
        "docs/tutorial/1-hello.md",
        "docs/tutorial/2-moving-nodes.md",
        "docs/tutorial/3-a-real-radio.md",
        "docs/tutorial/4-groups-and-parameters.md",
        "docs/tutorial/5-a-study.md",
        "docs/tutorial/6-the-figure.md",
        "docs/tutorial/7-what-was-lost.md",
    )
]
BLOCK = re.compile(
    r"(?:(?P<added>at the end of )?`(?P<name>\w+\.\w+)`:\n\n"
    r'(?:\{emphasize-lines="(?P<marked>[\d,-]+)"\}\n)?)?'
    r"^```(?P<language>\w+)\n(?P<text>.*?)^```",
    re.MULTILINE | re.DOTALL,
)


@dataclass(frozen=True)
class Step:
    """What a command printed, and where that is shown."""

    printed: str
    page: Path
    number: int | None = None
    """That of the block on the page which shows it."""


@dataclass(frozen=True)
class Played:
    """The directory of a reader after the last page, and what the commands printed."""

    folder: Path
    steps: list[Step]
    files: dict[str, dict[str, str]]
    """{page: {file: its text at the end of the page}}."""


def blocks(page: Path) -> Iterator[re.Match[str]]:
    """Return the code blocks of a page."""
    return BLOCK.finditer(page.read_text(encoding="utf-8"))


def is_installation(commands: str) -> bool:
    """Return whether the commands install gradysim, which is done already."""
    return "pip install" in commands


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> Played:
    """Save the files and run the commands of all pages, in order, in one directory."""
    folder = tmp_path_factory.mktemp("tutorial")
    program = tmp_path_factory.mktemp("bin") / "gradysim"
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m gradysim "$@"\n')
    program.chmod(0o755)
    path = os.pathsep.join([str(program.parent), str(Path(sys.executable).parent), os.environ["PATH"]])
    variables = {**os.environ, "PATH": path, "PYTHONPATH": str(ROOT / "python")}
    variables.pop("COLUMNS", None)  # pytest-xdist sets it; the pages show output of any width
    steps: list[Step] = []
    files: dict[str, dict[str, str]] = {}

    def run(command: str) -> str:
        if command.startswith("gradysim view hello.ini"):
            end, code, _ = watched(command, folder)
            assert (end["complete"], code) == (True, 0)
            return ""
        if command.startswith("gradysim view") and command.count(".html") > 1:
            assert visited(command, folder) == 0
            return ""
        command = command.replace("gradysim view", "gradysim view --no-browser")
        done = subprocess.run(
            command, shell=True, cwd=folder, env=variables, check=True, stdout=subprocess.PIPE, text=True
        )
        return done.stdout

    for page in PAGES:
        shown = 0
        for block in blocks(page):
            if block["language"] in ("python", "ini"):
                with (folder / block["name"]).open("a" if block["added"] else "w") as file:
                    file.write(block["text"])
            elif block["language"] == "sh" and not is_installation(block["text"]):
                printed = "".join(map(run, re.split(r"(?<!\\)\n", block["text"])))
                steps.append(Step(printed, page))
            elif block["language"] == "text":
                steps[-1] = replace(steps[-1], number=shown)
                shown += 1
        files[page.stem] = {
            file.name: file.read_text() for file in folder.iterdir() if file.suffix in (".py", ".ini")
        }
    return Played(folder, steps, files)


@pytest.mark.verify
def test_the_commands_print_what_is_shown(played: Played, shows: Callable[..., None]) -> None:
    for step in played.steps:
        if step.number is not None:
            shows(str(step.page.relative_to(ROOT)), step.printed, step.number, changing=True)


@pytest.mark.verify
def test_the_commands_leave_the_files_that_are_told(played: Played) -> None:
    names = {"map.png", "spread.png", "collected.pdf", "collected.csv", "collected.json", "lost.png"}
    assert names <= {file.name for file in played.folder.iterdir()}
    assert len(list((played.folder / "study").glob("*.json"))) == 160
    assert (played.folder / "results/Study-#20.integrated.html").is_file()


def test_highlighted_lines_are_those_that_are_new() -> None:
    before: dict[str, list[str]] = {}
    for block in (block for page in PAGES for block in blocks(page) if block["name"]):
        lines = block["text"].splitlines()
        name = block["name"]
        if name in before and not block["added"]:
            new = [
                number
                for tag, _, _, first, end in SequenceMatcher(
                    None, before[name], lines, autojunk=False
                ).get_opcodes()
                if tag != "equal"
                for number in range(first + 1, end + 1)
                if lines[number - 1]
            ]
            marked = [
                number
                for part in (block["marked"] or "").split(",")
                for number in range(int(part.partition("-")[0]), int(part.rpartition("-")[2]) + 1)
                if lines[number - 1]
            ]
            assert marked == new, (name, new)
        before[name] = [*before[name], *lines] if block["added"] else lines


def test_the_installation_is_of_this_project_with_its_plots() -> None:
    (commands,) = [block["text"] for block in blocks(PAGES[0]) if is_installation(block["text"])]
    assert commands.splitlines()[-1] == "pip install . matplotlib"


@pytest.mark.verify
def test_the_radio_reaches_as_far_as_it_says(played: Played, tmp_path: Path) -> None:
    text = PAGES[2].read_text(encoding="utf-8")
    (reach_m,) = re.findall(r"real radio reach (\d+) m by default", text)
    for name, content in played.files["2-moving-nodes"].items():
        (tmp_path / name).write_text(content)
    scenario = load_scenarios(tmp_path / "hello.ini")[0]
    here, one_metre_on = (calibrate(scenario, range_m=int(reach_m) + more).tx_power_w for more in (0, 1))
    assert here <= 0.020 < one_metre_on  # W, the default
    assert f"reach {reach_m} m by default" in COMMUNICATION_MEDIUM_KEYS[0].meaning
    migration = (ROOT / "docs/how-to/migrate-from-0.8.md").read_text(encoding="utf-8")
    assert f"its broadcasts reach {reach_m} m, and those of the prototype 60 m" in migration


def test_the_index_lists_the_pages() -> None:
    index = (ROOT / "docs/tutorial/index.md").read_text(encoding="utf-8")
    assert re.findall(r"^(\d-.*)$", index, re.MULTILINE) == [page.stem for page in PAGES]


def test_each_page_has_a_picture_a_try_and_a_next_page() -> None:
    for page, after in zip(PAGES, [*PAGES[1:], None], strict=True):
        text = page.read_text(encoding="utf-8")
        assert "](../pictures/tutorial/" in text, page.name
        assert "**Try**: " in text, page.name
        assert after is None or f"]({after.name})" in text.partition("**Next**: ")[2], page.name
