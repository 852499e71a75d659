"""`gradysim means`: from the files of `run --result-dir`."""

import pytest

from python.cli.command import interrupt_endless_run


def test_means_of_runs(gradysim):
    study = ("--set", "sim-time-limit=${limit=3, 5}.5s", "--result-dir", "out", "--quiet")
    gradysim("run", "test.ini", "--mode", "prototype", *study)
    done = gradysim("means", "out")
    assert (done.returncode, done.stderr) == (0, "")
    title, _, _, *rows = [line.split() for line in done.stdout.splitlines()]
    assert title == ["General,", "prototype", "mode"]
    assert [row for row in rows if "said" in row] == [
        ["3", "uavs[*]", "said", "3", "3", "0"],
        ["5", "uavs[*]", "said", "3", "5", "0"],
    ]
    in_csv = gradysim("means", "out", "--csv").stdout.splitlines()
    assert in_csv[0] == "config,mode,limit,quantity,runs,mean,low,high,left_out"
    assert "General,prototype,3,uavs[*] said,3,3.0,3.0,3.0," in in_csv


def test_only_the_quantities_that_are_wanted(gradysim):
    gradysim("run", "test.ini", "--mode", "prototype", "--result-dir", "out", "--quiet")

    every = gradysim("means", "out", "--csv").stdout.splitlines()
    assert any("delay" in line for line in every)
    assert gradysim("means", "out", "uavs[*] said", "--csv").stdout.splitlines() == [
        line for line in every if ",quantity," in line or ",uavs[*] said," in line
    ]
    two = gradysim("means", "out", "*delay*", "uavs[?] said", "--csv").stdout.splitlines()
    assert two == [line for line in every if ",quantity," in line or " said," in line or " delay " in line]
    assert "said" not in gradysim("means", "out", "*delay*").stdout


def test_a_quantity_that_is_not_there(gradysim):
    gradysim("run", "test.ini", "--mode", "prototype", "--result-dir", "out", "--quiet")
    done = gradysim("means", "out", "*delay*", "uavs said")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("out: ")
    assert done.stderr.endswith("`uavs[*] said`?\n")


def test_results_of_an_earlier_study_are_warned_of(gradysim):
    arguments = ("run", "test.ini", "--mode", "prototype", "--result-dir", "out", "--quiet")
    gradysim(*arguments)
    gradysim(*arguments, "-r", "0", "--set", "sim-time-limit=3.5s", "--replace")
    done = gradysim("means", "out")
    assert done.returncode == 0
    assert all(name in done.stderr for name in ("out: ", "General-#0", "General-#1"))


def test_results_of_different_protocols_are_warned_of(gradysim, folder):
    arguments = ("run", "test.ini", "--mode", "prototype", "--result-dir", "out", "--quiet")
    gradysim(*arguments, "-r", "0,1")
    (folder / "protocol.py").write_text((folder / "protocol.py").read_text() + "\n# edited")
    gradysim(*arguments, "-r", "2")
    done = gradysim("means", "out")
    assert done.returncode == 0
    assert " protocol.py " in done.stderr
    assert "General-#0.prototype and General-#2.prototype" in done.stderr


def test_runs_that_are_one_run_are_warned_of(gradysim):
    arguments = ("--mode", "prototype", "--result-dir", "out", "--quiet", "--set", "seed-set=5")
    gradysim("run", "test.ini", *arguments)
    done = gradysim("means", "out")
    assert done.returncode == 0
    assert " 2 of 3 " in done.stderr


def test_a_folder_without_results(gradysim, folder):
    done = gradysim("means", ".")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(".: ")


def test_a_folder_with_files_for_omnetpp_alone(gradysim, folder):
    gradysim("run", "test.ini", "--scalars")
    done = gradysim("means", "results")
    assert done.returncode == 2
    assert ".sca" in done.stderr


def test_a_folder_with_a_run_that_was_interrupted_alone(gradysim, folder):
    interrupt_endless_run(folder, "--mode", "prototype", "--result-dir", "out", "--scalars", "--quiet")
    assert {file.suffix for file in (folder / "out").iterdir()} == {".json", ".sca"}
    done = gradysim("means", "out")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("out: ")


def test_a_folder_whose_name_has_blanks_is_quoted_where_it_stands_in_a_command(gradysim, folder):
    (folder / "a b").mkdir()
    assert gradysim("means", "a b").stderr.endswith("--result-dir 'a b'`\n")


@pytest.mark.parametrize("name", ["nowhere", "test.ini"])
def test_a_folder_that_is_not_there(gradysim, name):
    done = gradysim("means", name)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"{name}: ")
