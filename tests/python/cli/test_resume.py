"""`gradysim run --resume`: remaining runs."""

import json

import pytest

from python.cli.command import objects


def results(folder):
    return {path.name: json.loads(path.read_text()) for path in (folder / "out").iterdir()}


def test_runs_that_have_a_result_are_left_out(gradysim, folder):
    arguments = ("run", "test.ini", "--mode", "prototype", "--quiet", "--result-dir", "out")
    gradysim(*arguments, "-r", "0,2")
    before = results(folder)
    done = gradysim(*arguments, "--resume", "--json")
    assert done.returncode == 0
    assert "(0,2)" in done.stderr
    assert [json.loads(line)["run"] for line in done.stdout.splitlines()] == [1]
    after = results(folder)
    assert len(after) == 3
    assert {name: after[name] for name in before} == before


def test_all_runs_may_be_there(gradysim):
    arguments = ("run", "test.ini", "--mode", "prototype", "--quiet", "--result-dir", "out", "-r", "1")
    gradysim(*arguments)
    done = gradysim(*arguments, "--resume")
    assert (done.returncode, done.stdout) == (0, "")
    assert "(1)" in done.stderr


def test_with_replace_runs_of_other_settings_start_again(gradysim, folder):
    arguments = ("run", "test.ini", "--mode", "prototype", "--quiet", "--result-dir", "out")
    gradysim(*arguments, "-r", "0", "--set", "sim-time-limit=2s")
    gradysim(*arguments, "-r", "1")
    done = gradysim(*arguments, "--resume", "--replace", "--json")
    assert [run["run"] for run in objects(done.stdout)] == [0, 2]
    assert {result["sim_time_s"] for result in results(folder).values()} == {10.5}


def test_runs_of_an_edited_protocol_begin_anew(gradysim, folder):
    arguments = ("run", "test.ini", "--mode", "prototype", "--quiet", "--result-dir", "out")
    gradysim(*arguments, "-r", "0,1")
    protocol = folder / "protocol.py"
    protocol.write_text(protocol.read_text().replace('["said"] += 1', '["said"] += 2'))
    done = gradysim(*arguments, "--resume")
    assert done.returncode == 0
    assert all(part in done.stderr for part in (" protocol.py ", "(0..1)"))
    said = {
        node["tracked_variables"]["said"] for result in results(folder).values() for node in result["nodes"]
    }
    assert said == {20}
    again = gradysim(*arguments, "--resume")
    assert "(0..2)" in again.stderr


def test_runs_of_an_edited_included_file_are_refused(gradysim, folder):
    (folder / "limit.ini").write_text("sim-time-limit = 3s\n")
    text = (folder / "test.ini").read_text().replace("sim-time-limit = 10.5s", "include limit.ini", 1)
    (folder / "test.ini").write_text(text)
    arguments = ("run", "test.ini", "--mode", "prototype", "--quiet", "--result-dir", "out")
    gradysim(*arguments)
    (folder / "limit.ini").write_text("sim-time-limit = 2s\n")
    assert gradysim(*arguments, "--resume").returncode == 2
    assert {result["sim_time_s"] for result in results(folder).values()} == {3}


@pytest.mark.parametrize("options", [[], ["--scalars"]])
def test_it_takes_a_folder(gradysim, options):
    done = gradysim("run", "test.ini", "--mode", "prototype", "--resume", *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("--resume: ")
    assert "--result-dir DIR" in done.stderr


def test_a_run_whose_file_has_a_changed_digit_begins_anew(gradysim, folder):
    arguments = ("run", "test.ini", "--mode", "prototype", "--quiet", "--result-dir", "out")
    gradysim(*arguments)
    file = folder / "out" / "General-#1.prototype.json"
    text = file.read_text()
    assert text.count('"said": 10') == 2
    file.write_text(text.replace('"said": 10', '"said": 11', 1))
    for command in (("means", "out"), ("plot", "out", "--x", "run", "--y", "uavs[*] said", "-o", "said.svg")):
        done = gradysim(*command)
        assert (done.returncode, done.stdout) == (2, "")
        assert done.stderr.startswith("out/General-#1.prototype.json: ")
    assert not (folder / "said.svg").exists()
    done = gradysim(*arguments, "--resume", "--json")
    assert [run["run"] for run in objects(done.stdout)] == [1]
    assert gradysim("means", "out").returncode == 0


def test_the_lock_of_a_killed_command_goes_if_all_runs_are_done(gradysim, folder):
    command = ("run", "test.ini", "--mode", "prototype", "--result-dir", "out")
    gradysim(*command)
    lock = folder / "out" / ".gradysim.lock"
    lock.touch()
    gradysim(*command, "--resume")
    assert not lock.exists()


@pytest.fixture
def grown(gradysim):
    """`grown(order)`: the result of --resume after `repeat` was raised from 20 to 21, for four values."""

    def grown(order):
        settings = ("*.uavs.count=${count=1, 2, 3, 4}", f"iteration-nesting-order={order}")
        words = [word for setting in settings for word in ("--set", setting)]
        arguments = ("run", "test.ini", "--mode", "prototype", "--quiet", "--result-dir", "out", *words)
        gradysim(*arguments, "--set", "repeat=20")
        return gradysim(*arguments, "--set", "repeat=21", "--resume", "--json")

    return grown


def test_another_repeat_changes_the_numbers_of_runs(grown):
    done = grown("*, repetition")
    assert (done.returncode, done.stdout) == (2, "")
    assert "60 of 84 " in done.stderr
    assert "`repeat`" in done.stderr


def test_all_runs_stay_if_repetitions_are_the_outermost(grown):
    done = grown("repetition, *")
    assert "(0..79)" in done.stderr
    assert [run["run"] for run in objects(done.stdout)] == [80, 81, 82, 83]
    assert {run["repetition"] for run in objects(done.stdout)} == {20}


def test_status_has_all_runs_if_repetitions_are_the_outermost(gradysim):
    settings = ("--set", "iteration-nesting-order=repetition, *", "--set", "*.uavs.count=${count=1, 2}")
    arguments = ("test.ini", "--mode", "prototype", *settings)
    gradysim("run", *arguments, "--quiet", "--result-dir", "out", "--set", "repeat=2")
    done = gradysim("status", "out", *arguments, "--set", "repeat=3")
    assert done.stdout.split()[1:4] == ["4", "of", "6"]
    assert "missing  2  4..5" in done.stdout
