"""`gradysim status`: which runs of a configuration are done."""

RUN = ("run", "test.ini", "--mode", "prototype", "--quiet", "--set", "repeat=6", "--result-dir", "out")
STATUS = ("status", "test.ini", "--result-dir", "out", "--mode", "prototype", "--set", "repeat=6")


def states(done):
    """Return {state: runs} of the printed table."""
    rows = [line.split("  ") for line in done.stdout.splitlines()[1:]]
    return {row[0]: row[-1] for row in rows}


def test_the_states_of_runs_are_listed(gradysim, folder):
    gradysim(*RUN, "-r", "0..2,5")
    gradysim(*RUN, "-r", "3", "--set", "sim-time-limit=2s")
    damaged = folder / "out" / "General-#1.prototype.json"
    damaged.write_text(damaged.read_text().replace('"said": 10', '"said": 11', 1))
    done = gradysim(*STATUS)
    assert done.returncode == 5
    assert done.stdout.splitlines() == [
        "General: 3 of 6 runs are done in out",
        "done                   3  0,2,5",
        "missing                1  4",
        "failed or interrupted  1  1",
        "of other settings      1  3",
    ]


def test_an_earlier_spelling_is_accepted(gradysim):
    gradysim(*RUN)
    done = gradysim("status", "out", "test.ini", *STATUS[4:])
    assert (done.returncode, states(done)) == (0, {"done": "0..5"})


def test_a_run_that_failed_is_not_done(gradysim):
    failing = ("-c", "Failing")
    gradysim(*RUN, *failing, "-r", "0")
    assert states(gradysim(*STATUS, *failing)) == {"failed or interrupted": "0", "missing": "1..5"}


def test_a_run_of_an_edited_protocol_is_not_done(gradysim, folder):
    gradysim(*RUN)
    (folder / "protocol.py").write_text((folder / "protocol.py").read_text() + "\n")
    assert states(gradysim(*STATUS)) == {"older than protocol.py": "0..5"}


def test_a_complete_study_has_exit_code_0(gradysim):
    gradysim(*RUN)
    done = gradysim(*STATUS)
    assert (done.returncode, states(done)) == (0, {"done": "0..5"})
    assert gradysim(*STATUS, "--missing").stdout == ""


def test_the_missing_runs_can_be_run(gradysim):
    gradysim(*RUN, "-r", "1,3")
    missing = gradysim(*STATUS, "--missing")
    assert (missing.returncode, missing.stdout) == (5, "0,2,4..5\n")
    gradysim(*RUN, "-r", missing.stdout.strip())
    assert gradysim(*STATUS, "--missing").returncode == 0


def test_only_selected_runs_are_listed(gradysim):
    gradysim(*RUN, "-r", "1,3")
    assert gradysim(*STATUS, "-r", "1,3").returncode == 0


def test_the_directory_must_exist(gradysim):
    done = gradysim("status", "nowhere", "test.ini")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("nowhere: ")


def test_the_seed_is_that_of_the_runs(gradysim):
    gradysim(*RUN, "--seed", "5")
    assert gradysim(*STATUS).returncode == 5
    assert gradysim(*STATUS, "--seed", "5").returncode == 0
