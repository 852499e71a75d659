import shlex
import subprocess
import sys

import pytest

from gradysim.cli.app import main
from gradysim.integrated.run import run
from gradysim.scenario import load_scenarios


@pytest.fixture
def project(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "swarm"]) == 0
    return tmp_path / "swarm"


def test_its_first_command_ends_in_the_viewer(project, capsys):
    assert project.is_dir()
    assert capsys.readouterr().out.split()[:3] == ["gradysim", "view", "swarm/swarm.ini"]


def test_its_test_passes(project):
    subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", project], check=True)


def test_jitter_mends_what_the_radio_breaks(project):
    heard = {}
    for config in ("General", "Jittered"):
        (scenario,) = load_scenarios(project / "swarm.ini", config)
        heard[config] = run(scenario).nodes[-1].tracked_variables["heard"]
    assert heard["General"] == 0
    assert heard["Jittered"] > 200


def test_every_run_of_its_study_can_be_checked(project):
    assert main(["check", "swarm/swarm.ini", "-c", "Study"]) == 0


def test_its_study_is_about_collisions(project):
    small, large = (
        run(load_scenarios(project / "swarm.ini", "Study")[number]).outcomes["frames"]["broadcast"]
        for number in (0, 3)
    )
    assert small["below_sensitivity"] == large["below_sensitivity"] == 0
    lost = {outcome: count for outcome, count in large.items() if count and outcome != "delivered"}
    assert set(lost) <= {"interference", "receiver_transmitting", "receiver_locked", "in_air"}
    assert 0.8 < large["delivered"] / sum(large.values()) < 0.97
    assert small["delivered"] / sum(small.values()) > 0.97


def test_its_commands_can_be_pasted(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "my swarm"]) == 0
    for line in capsys.readouterr().out.splitlines():
        folders = [word for word in shlex.split(line, comments=True) if "swarm" in word]
        assert folders
        assert all(word.startswith("my swarm") for word in folders)


def test_no_folder_is_written_over(project, capsys):
    before = (project / "swarm.ini").read_bytes()
    assert main(["new", "swarm"]) == 2
    assert "swarm" in capsys.readouterr().err
    assert (project / "swarm.ini").read_bytes() == before
