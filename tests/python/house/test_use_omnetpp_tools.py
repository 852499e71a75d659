"""Files and names in docs/how-to/use-omnetpp-tools.md are correct."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.results import read_scalars, read_vectors
from gradysim.results.omnetpp import RunIdentity, write_scalar_file
from gradysim.results.quantity import Scalar
from gradysim.scenario import load_scenarios

GUIDE = "docs/how-to/use-omnetpp-tools.md"
EXAMPLE = "docs/reference/example.md"

CodeBlocks = Callable[[str, str], list[str]]
Shell = Callable[[str, Path], str]


@pytest.fixture
def folder(code_blocks: CodeBlocks, tmp_path: Path) -> Path:
    """Return the directory of a reader with the example of the guides and its study."""
    (tmp_path / "hello.py").write_text(code_blocks(EXAMPLE, "python")[0], encoding="utf-8")
    text = "".join([*code_blocks(EXAMPLE, "ini")[:2], *code_blocks(GUIDE, "ini")])
    (tmp_path / "hello.ini").write_text(text, encoding="utf-8")
    return tmp_path


@pytest.fixture
def shown(code_blocks: CodeBlocks) -> dict[str, Any]:
    """Return the functions defined on the page."""
    names: dict[str, Any] = {}
    exec("\n".join(code_blocks(GUIDE, "python")), names)
    return names


@pytest.mark.verify
def test_its_commands_write_what_its_functions_read(
    code_blocks: CodeBlocks, shell: Shell, folder: Path, shown: dict[str, Any]
) -> None:
    (commands,) = code_blocks(GUIDE, "sh")
    shell(commands, folder)
    heard = shown["heard"](str(folder / "results"))
    assert heard["Study", "prototype", "10ms"] == heard["Study", "integrated", "10ms"] == 177
    assert heard["Study", "integrated", "100us"] < heard["Study", "integrated", "1ms"] < 177
    times = shown["first_times"](str(folder / "results/Study-#0.integrated.vec"))
    assert list(times) == ["Network.nodes[0].protocol", "Network.nodes[1].protocol"]
    assert all(1 < time < 1.1 for time in times.values())


def test_its_means_are_of_one_configuration_and_of_whole_runs(tmp_path: Path, shown: dict[str, Any]) -> None:
    for number, (config, interrupted, jitter, value) in enumerate(
        [
            ("Study", "false", {"jitter": "10ms"}, 4),
            ("Study", "false", {"jitter": "10ms"}, 6),
            ("Study", "true", {"jitter": "10ms"}, 1),
            ("Other", "false", {"jitter": "10ms"}, 7),
            ("Plain", "false", {}, 8),
        ]
    ):
        attributes = {"configname": config, "mode": "prototype", "interrupted": interrupted}
        identity = RunIdentity(f"{config}-{number}", attributes, jitter, ())
        found = [Scalar("Network.nodes[0].protocol", "heard:last", value)]
        write_scalar_file(found, identity, tmp_path / f"{number}.sca")
    assert shown["heard"](str(tmp_path)) == {
        ("Study", "prototype", "10ms"): 5,
        ("Other", "prototype", "10ms"): 7,
        ("Plain", "prototype", ""): 8,
    }


def test_nodes_that_hear_nothing_have_no_first_time(
    shell: Shell, folder: Path, shown: dict[str, Any]
) -> None:
    far = "--set '*.nodes[3].mobility.initialX=100km'"
    shell(f"gradysim run hello.ini --mode prototype --vectors all --quiet {far}", folder)
    times = shown["first_times"](str(folder / "results/General-#0.prototype.vec"))
    assert list(times) == [f"Network.nodes[{index}].protocol" for index in range(3)]


def test_its_tables_have_the_names_that_are_written(shell: Shell, root: Path, folder: Path) -> None:
    text = (root / GUIDE).read_text()
    table = text.partition("| module | scalars |")[2].partition("\n\n")[0]
    named = set()
    for module, cell in re.findall(r"^\| `(.*?)` \| (.*) \|$", table, re.MULTILINE):
        named |= {(module, name) for name in re.findall(r"`([a-z]\w*:[^`]+|\w+Time)`", cell)}
    options = "-c Hidden --scalars --vectors all --quiet"
    with (folder / "hello.ini").open("a") as file:
        file.write(
            "[Config Hidden]\n*.nodes[*].mobility.lineStepX = 400m\n*.nodes[*].protocol.jitter = 1ms\n"
        )
        file.write('**.mac.dcf.rateControl.typename = "ArfRateControl"\n')
    shell(f"gradysim run hello.ini {options} --outcomes-at all", folder)
    shell(f"gradysim run hello.ini {options} --mode prototype", folder)
    written = {(row["module"], row["name"]) for row in read_scalars(folder.glob("results/*.sca"))}
    never_here = {
        ("Network.nodes[0]", "unicast:54Mbps:count"),
        ("Network.nodes[0]", "interferer:nodes[1]:count"),
    }
    assert len(named) > 15
    assert named - written - never_here == set()
    vectors = {(row["module"], row["name"]) for row in read_vectors(folder.glob("results/*.vec"))}
    assert {name for _, name in vectors} == set(re.findall(r"`(\w+:vector)`", text))


def test_its_columns_are_those_of_rows(shell: Shell, root: Path, folder: Path) -> None:
    shell("gradysim run hello.ini -c Labelled -r 0 --scalars --vectors all --quiet", folder)
    rows = [*read_scalars(folder.glob("results/*.sca")), *read_vectors(folder.glob("results/*.vec"))]
    table = (root / GUIDE).read_text().partition("| column | meaning |")[2].partition("\n\n")[0]
    named = {
        name
        for row in re.findall(r"^\| (`.*?) \|", table, re.MULTILINE)
        for name in re.findall(r"`(\w+)`", row)
    }
    assert named <= {column for row in rows for column in row}
    attributes = (root / GUIDE).read_text().partition("The attributes of a run are")[2].partition("\n\n")[0]
    assert set(re.findall(r"`(\w+)`", attributes)) <= rows[0].keys()


def test_its_labels(folder: Path) -> None:
    variables = load_scenarios(folder / "hello.ini", "Labelled")[0].variables
    assert [variables[name] for name in ("experiment", "measurement", "replication")] == [
        "greetings in Network",
        "jitter of 100us",
        "seed 0",
    ]
