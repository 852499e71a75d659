"""`gradysim run --quiet`: no output without an error."""

from python.cli.command import both_modes, compiled, objects


@both_modes
def test_quiet_runs_say_nothing_of_themselves(gradysim, folder, mode):
    done = gradysim("run", "test.ini", "--mode", mode, "--quiet", "--result-dir", "out", "-r", "0,1")
    assert (done.returncode, done.stdout, done.stderr) == (0, "printed by a protocol\n" * 4, "")
    assert len(list((folder / "out").iterdir())) == 2


@both_modes
def test_quiet_runs_say_why_they_fail(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Failing", "--mode", mode, "--quiet", "-r", "0")
    assert (done.returncode, done.stdout) == (1, "printed by a protocol\n" * 2)
    assert "spoilt" in done.stderr


def test_quiet_runs_print_the_json_that_was_asked_for(gradysim):
    done = gradysim("run", "test.ini", "--mode", "prototype", "--quiet", "--json", "-r", "0")
    assert [run["run"] for run in objects(done.stdout)] == [0]


@compiled
def test_quiet_runs_do_not_name_their_capture_files(gradysim, folder):
    done = gradysim("run", "test.ini", "--quiet", "--pcap", "all", "-r", "0")
    assert "captured" not in done.stdout
    assert len(list((folder / "results").iterdir())) == 2
