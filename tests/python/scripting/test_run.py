"""`gradysim.run`, `load` and `runs`, as scripts call them."""

import pickle
import subprocess
import sys
from html import unescape
from pathlib import Path

import pytest

import gradysim as gs
from gradysim.cli.errors import FAILED
from gradysim.cli.options import RunOptions
from gradysim.cli.run import run_study
from gradysim.results import Runs
from gradysim.results.result import RunResult
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.load import Study
from gradysim.scripting.run import StudyError
from python.quiet_protocol import QUIET

pytest.importorskip("gradysim._netsim")

PROTOCOL = f"""{QUIET}
from gradysim.protocol.messages.communication import BroadcastMessageCommand

class Talker(Quiet):
    fails_in_run: int = -1
    heard: int = 0
    def initialize(self):
        self.provider.schedule_timer("talk", 0.1 + 0.01 * self.provider.get_id())
    def handle_timer(self, timer):
        if f"#{{self.fails_in_run}}." in (self.provider.run_name or "#0."):
            raise RuntimeError("spoilt")
        self.provider.send_communication_command(BroadcastMessageCommand("hello"))
        self.provider.schedule_timer("talk", self.provider.current_time() + 0.1)
    def handle_packet(self, message):
        self.heard += 1
        self.provider.tracked_variables["heard"] = self.heard
"""

INI = """[General]
sim-time-limit = 1s
*.numUavs = 2
*.uavs[*].protocol.class = "talker.py:Talker"
*.uavs[1].mobility.initialX = 20m

[Config Study]
*.uavs[1].mobility.initialX = ${x = 10m, 30m}
repeat = 2
"""

MODES = pytest.mark.parametrize("mode", ["prototype", "integrated"])


@pytest.fixture
def file(tmp_path: Path) -> Path:
    (tmp_path / "talker.py").write_text(PROTOCOL)
    (tmp_path / "talk.ini").write_text(INI)
    return tmp_path / "talk.ini"


def test_the_names_of_the_package_are_those_for_scripts() -> None:
    program = "import gradysim; print(*dir(gradysim))"
    shown = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert shown.stdout.split() == ["__version__", "installation", "load", "run", "runs", "start"]


@MODES
def test_a_single_run_gives_its_result(file: Path, mode: str) -> None:
    result = gs.run(file, mode=mode)
    assert isinstance(result, RunResult)
    assert result.mode == mode
    assert [node.tracked_variables["heard"] >= 9 for node in result.nodes] == [True, True]


@MODES
def test_a_scenario_gives_the_result_of_its_run(file: Path, mode: str) -> None:
    scenario = gs.load(file, "Study")[2]
    result = gs.run(scenario, mode=mode)
    assert result.run == 2
    assert result.nodes == gs.run(file, "Study", runs=2, mode=mode).nodes


@MODES
def test_a_study_gives_the_table_of_its_runs(file: Path, mode: str) -> None:
    study = gs.run(file, "Study", mode=mode, jobs=2)
    assert isinstance(study, Runs)
    single = [gs.run(scenario, mode=mode) for scenario in gs.load(file, "Study")]
    assert [run.run for run in study] == [0, 1, 2, 3]
    assert study.values("x") == ["10m", "30m"]
    assert [run.number("events") for run in study] == [result.events for result in single]


def test_the_table_of_a_study_has_means_and_figures(file: Path) -> None:
    study = gs.run(file, "Study")
    assert isinstance(study, Runs)
    assert [mean.mean for mean in study.means("uavs[*] heard")] == [9, 9]
    figure = study.plot(x="x", y="uavs[*] heard")
    assert figure.axes[0].get_ylabel() == "uavs[*] heard"


def test_results_stay_in_a_directory_and_are_resumed(file: Path, tmp_path: Path) -> None:
    directory = tmp_path / "results"
    gs.run(file, "Study", runs="0,1", result_dir=directory)
    first = {run.run: run.file.stat().st_mtime_ns for run in gs.runs(directory)}
    study = gs.run(file, "Study", result_dir=directory, resume=True)
    assert isinstance(study, Runs)
    assert [run.run for run in study] == [0, 1, 2, 3]
    assert {run.run: run.file.stat().st_mtime_ns for run in study if run.run < 2} == first


def test_a_single_run_with_a_directory_is_a_table(file: Path, tmp_path: Path) -> None:
    study = gs.run(file, result_dir=tmp_path / "results")
    assert isinstance(study, Runs)
    assert [run.config for run in study] == ["General"]


def test_results_of_other_configurations_are_not_in_the_table(file: Path, tmp_path: Path) -> None:
    gs.run(file, result_dir=tmp_path / "results")
    study = gs.run(file, "Study", result_dir=tmp_path / "results")
    assert isinstance(study, Runs)
    assert study.values("config") == ["Study"]


def test_temporary_results_exist_as_long_as_the_table_or_a_part_of_it(file: Path) -> None:
    study = gs.run(file, "Study")
    assert isinstance(study, Runs)
    part, result_file = study.where(x="30m"), study[0].file
    del study
    assert result_file.is_file()
    del part
    assert not result_file.parent.exists()


def test_a_failed_run_is_an_error_that_names_the_missing_runs(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    overrides = ["*.uavs[*].protocol.fails_in_run = 1"]
    with pytest.raises(StudyError) as failed:
        gs.run(file, "Study", overrides=overrides, result_dir=tmp_path / "results")
    assert failed.value.exit_code == 1
    assert 1 in failed.value.missing
    assert "spoilt" in capsys.readouterr().err
    assert pickle.loads(pickle.dumps(failed.value)).missing == failed.value.missing


def test_runs_that_never_begin_are_no_progress(file: Path, tmp_path: Path) -> None:
    study = gs.load(file, "Study", overrides=["*.uavs[*].protocol.fails_in_run = 0"])
    options = RunOptions(config="Study", result_dir=tmp_path / "results", quiet=True)
    progress: list[tuple[int, int]] = []
    assert run_study(study, file, options, lambda *ended: progress.append(ended)) == FAILED
    assert progress == [(0, 4), (1, 4)]


def test_a_single_run_raises_what_its_protocol_raises(file: Path) -> None:
    with pytest.raises(RuntimeError, match="spoilt"):
        gs.run(file, overrides=["*.uavs[*].protocol.fails_in_run = 0"])


def test_a_mistake_in_the_file_is_an_error(file: Path) -> None:
    with pytest.raises(ConfigError) as mistake:
        gs.run(file, "Sturdy")
    assert mistake.value.suggestion == "Study"


def test_there_is_no_third_mode(file: Path) -> None:
    with pytest.raises(ValueError, match="'fast'"):
        gs.run(file, "Study", mode="fast")  # type: ignore[call-overload]


@MODES
def test_a_result_shows_its_replay(file: Path, mode: str) -> None:
    result = gs.run(file, mode=mode, replay="all")
    assert isinstance(result, RunResult)
    page = result.replay_page
    assert page is not None
    assert 'id="gradysim-end"' in page
    assert page in unescape(result.view()._repr_html_())


def test_a_run_of_a_study_shows_its_replay(file: Path) -> None:
    study = gs.run(file, "Study", replay=["uavs[0]"])
    assert isinstance(study, Runs)
    assert "gradysim-end" in study[3].view(height_px=300)._repr_html_()


def test_a_result_without_a_replay_says_how_to_get_one(file: Path) -> None:
    result = gs.run(file, runs=0)
    with pytest.raises(ValueError, match='replay="all"'):
        result.view()


def test_a_replay_of_no_node_is_an_error(file: Path) -> None:
    with pytest.raises(ConfigError) as mistake:
        gs.run(gs.load(file)[0], replay="uav")
    assert mistake.value.suggestion == "uavs"


def test_runs_are_loaded_as_they_are_asked_for(file: Path) -> None:
    study = gs.load(file, "Study", runs=[1, 3])
    assert isinstance(study, Study)
    assert [scenario.run_number for scenario in study] == [1, 3]
    assert [scenario.run_number for scenario in gs.load(file, "Study", 2)] == [2]


def test_scenario_study_result_and_table_show_themselves_as_html(file: Path) -> None:
    study = gs.load(file, "Study")
    runs = gs.run(file, "Study")
    assert isinstance(runs, Runs)
    assert "<td>30m</td>" in study._repr_html_()
    assert "<td>Talker</td><td>2</td>" in study[0]._repr_html_()
    assert "<td>uavs[1]</td><td>9</td>" in gs.run(study[0])._repr_html_()
    assert "<td>30m</td><td>uavs[*] heard</td><td>9</td>" in runs._repr_html_()
    assert repr(runs) == "<4 runs of Study>"
    assert repr(study) == f"<4 runs of Study in {file}>"
