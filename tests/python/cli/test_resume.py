"""`gradysim run --resume`: what is left of many runs."""

import json


def results(folder):
    return {path.name: json.loads(path.read_text()) for path in (folder / "out").iterdir()}


def test_runs_that_have_a_result_are_left_out(gradysim, folder):
    arguments = ("run", "test.ini", "--mode", "prototype", "--quiet", "--result-dir", "out")
    gradysim(*arguments, "-r", "0,2")
    before = results(folder)
    done = gradysim(*arguments, "--resume", "--json")
    assert done.returncode == 0
    assert "General: 2 of 3 runs are in out (0,2) and left out\n" in done.stderr
    assert [json.loads(line)["run"] for line in done.stdout.splitlines()] == [1]
    after = results(folder)
    assert len(after) == 3
    assert {name: after[name] for name in before} == before


def test_all_runs_may_be_there(gradysim):
    arguments = ("run", "test.ini", "--mode", "prototype", "--quiet", "--result-dir", "out", "-r", "1")
    gradysim(*arguments)
    done = gradysim(*arguments, "--resume")
    assert (done.returncode, done.stdout) == (0, "")
    assert done.stderr.endswith("General: 1 of 1 runs is in out (1) and left out\n")


def test_a_result_of_other_settings_is_replaced(gradysim, folder):
    arguments = ("run", "test.ini", "--mode", "prototype", "--quiet", "--result-dir", "out", "-r", "0")
    gradysim(*arguments)
    gradysim(*arguments, "--resume", "--set", "sim-time-limit=2s")
    (result,) = results(folder).values()
    assert result["sim_time_s"] == 2


def test_it_takes_a_folder(gradysim):
    done = gradysim("run", "test.ini", "--resume")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "--resume: there is no folder to look into; expected --result-dir DIR, too\n"
