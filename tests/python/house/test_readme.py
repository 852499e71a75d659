"""The output in README.md is correct."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.scenario import load_scenarios
from gradysim.scenario.keys import COMMUNICATION_MEDIUM_KEYS
from python.viewing import watched

README = Path(__file__).parents[3] / "README.md"


@pytest.fixture
def first_protocol(root: Path, tmp_path: Path) -> Path:
    """Save the two files of the first protocol, like a reader; return the .ini file."""
    readme = (root / "README.md").read_text()
    for language, name in [("python", "hello.py"), ("ini", "hello.ini")]:
        block = re.search(rf"^```{language}\n(.*?)^```", readme, re.MULTILINE | re.DOTALL)
        assert block is not None
        (tmp_path / name).write_text(block[1])
    return tmp_path / "hello.ini"


def heard(run: Callable[..., Any], file: Path, config: str) -> list[int]:
    """Return the number of greetings that each node heard."""
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

    assert heard(run, first_protocol, "Jittered") == [177] * 4


def test_the_radio_reaches_as_far_as_it_says(first_protocol: Path) -> None:
    pytest.importorskip("gradysim._netsim")
    from gradysim.integrated.calibration import calibrate

    (reach_m,) = re.findall(r"broadcasts of the real radio (\d+) m", README.read_text())
    scenario = load_scenarios(first_protocol)[0]
    here, one_metre_on = (calibrate(scenario, range_m=int(reach_m) + more).tx_power_w for more in (0, 1))
    assert here <= 0.020 < one_metre_on  # W, the default


def test_who_changes_the_mode_learns_of_the_ranges_elsewhere_too(root: Path) -> None:
    told = re.findall(r"broadcasts of the real radio (\d+ m)", README.read_text())
    transmission_range = COMMUNICATION_MEDIUM_KEYS[0].meaning
    assert re.findall(r"reach (\d+ m) by default", transmission_range) == told
    migration = (root / "docs/how-to/migrate-from-0.8.md").read_text()
    assert re.findall(r"its broadcasts reach (\d+ m), and those of the prototype 60 m", migration) == told


def test_one_line_gives_both_modes_one_range(first_protocol: Path) -> None:
    pytest.importorskip("gradysim._netsim")
    import gradysim.integrated.run
    import gradysim.prototype.run

    (line,) = re.findall(r"`(\*\*\.wlan.*communicationRange = 60m)`", README.read_text())
    ends = "*.nodes[*].mobility.lineStepX = 59m"
    settings = [line, ends, "*.nodes[*].protocol.jitter = 100ms"]
    scenario = load_scenarios(first_protocol, overrides=settings)[0]
    for run in (gradysim.prototype.run.run, gradysim.integrated.run.run):
        heard_by = [node.tracked_variables["heard"] for node in run(scenario).nodes]
        assert heard_by == [59, 118, 118, 59]


def test_what_the_command_prints_is_explained(root: Path, first_protocol: Path) -> None:
    pytest.importorskip("gradysim._netsim")
    from gradysim.integrated.run import run

    readme = " ".join((root / "README.md").read_text().split())
    section = readme.partition("## What the output means")[2].partition("## ")[0]
    fates = run(load_scenarios(first_protocol)[0]).fates
    names = {
        fate.replace("_", " ") for kinds in fates.values() for counts in kinds.values() for fate in counts
    }
    columns = {word for kinds in fates.values() for kind in kinds for word in kind.split()}
    assert {name for name in names if name not in section.replace("lost to ", "")} == set()
    assert columns - {"broadcast", "rts", "cts"} <= set(re.findall(r"\w+", section))


def test_its_links_lead_somewhere(root: Path) -> None:
    links = re.findall(r"\]\(([^)#]+)\)", (root / "README.md").read_text())
    assert [link for link in links if "://" not in link and not (root / link).exists()] == []


def test_the_commands_of_the_first_protocol_print_what_is_said(
    first_protocol: Path, shell: Callable[..., str]
) -> None:
    lines = re.findall(r"^(gradysim run .*?) +# .*heard = (\d+)$", README.read_text(), re.MULTILINE)
    assert len(lines) == 3
    for command, heard_by_each in lines:
        result = json.loads(shell(f"{command} --json --quiet", first_protocol.parent))
        assert [node["tracked_variables"]["heard"] for node in result["nodes"]] == [int(heard_by_each)] * 4


def test_the_study_has_the_runs_and_the_files_that_are_told(
    first_protocol: Path, shell: Callable[..., str]
) -> None:
    readme = README.read_text()
    (study,) = re.findall(r"^```ini\n(\[Config Study\]\n.*?)^```", readme, re.MULTILINE | re.DOTALL)
    with first_protocol.open("a") as file:
        file.write(study)
    commands = re.findall(
        r"^(gradysim runs? hello.ini -c Study.*?) +# (.*), and so on$", readme, re.MULTILINE
    )
    (listing, first_line), (running, first_file) = commands
    lines = shell(listing, first_protocol.parent).splitlines()
    assert (lines[0], len(lines)) == (first_line, 30)
    shell(f"{running} --quiet", first_protocol.parent)
    assert (first_protocol.parent / first_file).is_file()
    assert len(list((first_protocol.parent / "results").iterdir())) == 30
    (figure,) = re.findall(r"`(gradysim plot results .*?)`", readme)
    shell(figure, first_protocol.parent)
    assert (first_protocol.parent / "heard.png").is_file()


def test_the_commands_of_docker_name_what_there_is(root: Path) -> None:
    lines = re.findall(r"^docker (.*)$", README.read_text(), re.MULTILINE)
    assert len(lines) == 4
    for name in re.findall(r"\S+/\S+", " ".join(lines)):
        assert (root / name).exists()
    for file, config in re.findall(r"gradysim (?:run|view) (\S+) -c (\S+)", " ".join(lines)):
        load_scenarios(root / file, config)


def test_its_commands_are_those_of_make(root: Path) -> None:
    targets = set(re.findall(r"^([a-z-]+):.*##", (root / "Makefile").read_text(), re.MULTILINE))
    for document in ["README.md", "CONTRIBUTING.md"]:
        named = set(re.findall(r"(?:^|`)make ([a-z-]+)", (root / document).read_text(), re.MULTILINE))
        assert named <= targets, document


def test_contributing_lists_every_command(root: Path) -> None:
    targets = set(re.findall(r"^([a-z-]+):.*##", (root / "Makefile").read_text(), re.MULTILINE))
    table = set(re.findall(r"^\| `make ([a-z-]+)`", (root / "CONTRIBUTING.md").read_text(), re.MULTILINE))
    assert targets - table == {"help"}


def test_each_line_of_its_sh_snippets_is_of_a_kind_that_is_tested_here() -> None:
    snippets = re.findall(r"^```sh\n(.*?)^```", README.read_text(), re.MULTILINE | re.DOTALL)
    lines = "".join(snippets).split("\n")
    known = re.compile(
        r"make [a-z-]+ .*|docker .*|gradysim run .* # .*heard = \d+|gradysim runs? .* -c Study .*# .*|"
        r"gradysim (new|view) .* # .*|gradysim run swarm/.* --replay all .*# .*|"
        r"python -m pytest swarm .*# .*|"
    )
    assert [line for line in lines if not known.fullmatch(line)] == []


def test_the_first_commands_do_what_is_said(tmp_path: Path, shell: Callable[..., str]) -> None:
    new, view, *others, run = re.findall(r"^(gradysim .*swarm.*?) +# ", README.read_text(), re.MULTILINE)
    shell(new, tmp_path)
    for command in (view, *others):
        end, code, _ = watched(command, tmp_path)
        assert end["complete"]
        assert code == 0
    shell(run, tmp_path)
    assert (tmp_path / "results/General-#0.integrated.html").exists()
    shell(re.findall(r"^(python -m pytest swarm) +# ", README.read_text(), re.MULTILINE)[0], tmp_path)


def test_the_first_protocol_can_be_watched(first_protocol: Path) -> None:
    (command,) = re.findall(r"^(gradysim view hello.ini) +# ", README.read_text(), re.MULTILINE)
    assert watched(command, first_protocol.parent)[0]["complete"]
