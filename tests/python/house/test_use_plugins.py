"""What docs/how-to/use-plugins.md shows is what happens, in both modes."""

import csv
import importlib
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.protocol.plugin.random_mobility import RandomMobilityConfig
from gradysim.results.result import RunResult
from gradysim.scenario import load_scenarios

Run = Callable[[str], RunResult]


@pytest.fixture
def guide(
    code_blocks: Callable[[str, str], list[str]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Path:
    """The folder with the guide's two files, as a reader would save them; it is the working directory."""
    for language, name in [("python", "guide.py"), ("ini", "guide.ini")]:
        (tmp_path / name).write_text("\n\n".join(code_blocks("docs/how-to/use-plugins.md", language)))
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(params=["prototype", "integrated"])
def run(request: pytest.FixtureRequest, guide: Path) -> Run:
    """`run("Follow")`: run that configuration of the guide."""
    if request.param == "integrated":
        pytest.importorskip("gradysim._netsim")
    module: Any = importlib.import_module(f"gradysim.{request.param}.run")

    def run_config(config: str) -> RunResult:
        (scenario,) = load_scenarios(guide / "guide.ini", config)
        result: RunResult = module.run(scenario)
        return result

    return run_config


def tracked(result: RunResult, name: str) -> list[Any]:
    return [node.tracked_variables.get(name) for node in result.nodes]


def test_a_patrol_turns_round(run: Run) -> None:
    assert tracked(run("Patrol"), "waypoint") == [0]


def test_a_trip_stays_in_its_box(run: Run) -> None:
    box = RandomMobilityConfig((-100, 100), (0, 50), (10, 30))
    targets = tracked(run("Wander"), "target")
    assert len(set(targets)) == 3
    for target in targets:
        for value, (lowest, highest) in zip(target, (box.x_range, box.y_range, box.z_range), strict=True):
            assert lowest <= value <= highest


def test_followers_queue_up_behind_their_leader(run: Run) -> None:
    result = run("Follow")
    assert result.nodes[0].tracked_variables["followers"] == [1, 2, 3]
    for node in result.nodes:
        assert node.position == pytest.approx((0, 50 - 5 * node.id, 20))


def test_statistics_are_written(run: Run) -> None:
    heard = tracked(run("Count"), "heard")[0]
    times, values = (
        list(csv.DictReader(Path(f"{kind}_demo_Counter_0.csv").read_text(encoding="utf-8").splitlines()))
        for kind in ("simulation_real_time", "tracked_variables")
    )
    assert list(times[0]) == ["", "simulation_time", "real_time"]
    assert list(values[0]) == ["", "simulation_time", "heard"]
    assert len(values) == len(times) + heard
    assert values[-1]["heard"] == str(heard)


def test_one_of_several_runs_leaves_the_file_that_it_names(guide: Path, root: Path) -> None:
    pytest.importorskip("gradysim._netsim")
    from gradysim.integrated.run import run

    (name,) = re.findall(
        r"`(tracked_variables_Count-#3\S+)`", (root / "docs/how-to/use-plugins.md").read_text()
    )
    (scenario,) = load_scenarios(guide / "guide.ini", "Count", "3", overrides=["repeat = 4"])
    run(scenario)
    assert [file.name for file in guide.glob("tracked_variables_*_0.csv")] == [name]


def test_pings_are_answered_and_not_seen(run: Run) -> None:
    assert tracked(run("Ping"), "answer") == ["pong", "pong"]


def test_the_script_flies_in_formation(guide: Path, imported: Callable[[Path], Any]) -> None:
    positions = imported(guide / "guide.py").fly_in_formation()
    assert positions == [pytest.approx((0, 50 - 5 * node_id, 20)) for node_id in range(4)]


def test_its_types_hold(guide: Path, type_errors: Callable[[Path], str]) -> None:
    assert type_errors(guide / "guide.py") == ""


def test_its_commands_work(
    guide: Path, code_blocks: Callable[[str, str], list[str]], shell: Callable[[str, Path], str]
) -> None:
    (commands,) = code_blocks("docs/how-to/use-plugins.md", "sh")
    assert shell(commands, guide).count("Follow") >= 2
