"""The output in docs/how-to/migrate-from-0.8.md is correct."""

import importlib
import re
import shlex
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.cli.app import main
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.scenario import ConfigError, load_scenarios

PAGE = "docs/how-to/migrate-from-0.8.md"

CodeBlocks = Callable[[str, str], list[str]]


def translations() -> list[tuple[str, str]]:
    """Return the rows of the table of keys: a line of an omnetpp.ini, and its translation."""
    text = (Path(__file__).parents[3] / PAGE).read_text()
    table = text.split("| in `omnetpp.ini` | here |\n|---|---|\n")[1].split("\n\n")[0]
    rows = [re.fullmatch(r"\| `(.+?)` \| (?:`(.+)`|delete.*?) \|", line) for line in table.splitlines()]
    return [(row[1], row[2] or "") for row in rows if row is not None]


@pytest.fixture
def folder(code_blocks: CodeBlocks, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the directory with the page's files, as a reader would save them.

    It is the working directory.
    """
    (survey,) = code_blocks(PAGE, "ini")
    (tmp_path / "survey.ini").write_text(survey)
    (tmp_path / "survey.py").write_text("\n\n".join(code_blocks(PAGE, "python")))
    (tmp_path / "omnetpp.ini").write_text(code_blocks(PAGE, "text")[1])
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def survey(folder: Path, imported: Callable[[Path], Any]) -> Any:
    """Import the page's Python file."""
    return imported(folder / "survey.py")


def with_lines(folder: Path, *lines: str) -> Path:
    """Return the page's .ini file with additional lines, which take precedence."""
    file = folder / "changed.ini"
    file.write_text(
        (folder / "survey.ini").read_text().replace("[General]", "\n".join(("[General]", *lines)), 1)
    )
    return file


def test_the_script_prints_what_is_shown(
    survey: Any, code_blocks: CodeBlocks, shows: Callable[..., None]
) -> None:
    assert code_blocks(PAGE, "sh")[0] == "python survey.py\n"
    shows(PAGE, f"{survey.survey()}")


def test_who_seeds_pythons_random_gets_the_same_run_again(survey: Any) -> None:
    assert survey.build_and_draw(1) == survey.build_and_draw(1)
    assert survey.build_and_draw(1) != survey.build_and_draw(2)


def test_a_failure_can_be_caught_and_tells_its_place(survey: Any) -> None:
    class Broken(IProtocol):
        def initialize(self) -> None:
            self.provider.schedule_timer("", 2)

        def handle_timer(self, timer: str) -> None:
            print(1 / 0)

        def handle_packet(self, message: str) -> None: ...

        def handle_telemetry(self, telemetry: Telemetry) -> None: ...

        def finish(self) -> None: ...

    place = "in handle_timer of node 0 (Broken 0) at 2 s of simulated time"
    assert survey.failure_of(Broken) == f"division by zero {place}"


def test_its_types_hold(folder: Path, type_errors: Callable[[Path], str]) -> None:
    assert type_errors(folder / "survey.py") == ""


@pytest.mark.parametrize("mode", ["prototype", "integrated"])
def test_the_translated_file_runs(folder: Path, mode: str) -> None:
    if mode == "integrated":
        pytest.importorskip("gradysim._netsim")
    scenarios = load_scenarios(folder / "survey.ini")
    assert len(scenarios) == 3
    result = importlib.import_module(f"gradysim.{mode}.run").run(scenarios[0])
    assert [node.protocol for node in result.nodes] == ["Collector", "Sensor", "Sensor", "Sensor"]
    assert result.nodes[0].tracked_variables["collected"] > 30


def test_its_commands_work(folder: Path, code_blocks: CodeBlocks, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("gradysim._netsim")
    for line in "".join(code_blocks(PAGE, "sh")[1:]).splitlines():
        program, *arguments = shlex.split(line)
        assert program == "gradysim"
        assert main(arguments) == 0, capsys.readouterr().err


def test_an_untranslated_file_is_an_error_that_names_the_line(folder: Path) -> None:
    with pytest.raises(ConfigError, match=r"omnetpp\.ini:\d+: "):
        load_scenarios(folder / "omnetpp.ini")


def test_the_table_of_keys_is_read() -> None:
    assert len(translations()) > 20


@pytest.mark.parametrize(("before", "after"), translations())
def test_a_line_of_an_omnetpp_ini_has_to_be_translated(folder: Path, before: str, after: str) -> None:
    if before == after:
        load_scenarios(with_lines(folder, before))
    else:
        with pytest.raises(ConfigError, match=r"changed\.ini:\d+: "):
            load_scenarios(with_lines(folder, before))


@pytest.mark.parametrize("after", [after for _, after in translations() if after])
def test_a_translated_line_is_understood(folder: Path, after: str) -> None:
    load_scenarios(with_lines(folder, after))


def test_what_is_said_of_ignored_keys_is_so(folder: Path) -> None:
    ignored = ["cmdenv-express-mode = true", "qtenv-default-config = X", "result-dir = out"]
    load_scenarios(with_lines(folder, *ignored, "**.x.scalar-recording = false", "*.visualizer.a.b = 3"))
