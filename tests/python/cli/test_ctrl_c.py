"""Effect of Ctrl-C on a run."""

import os

from python.cli.command import PROTOCOL, both_modes, interrupt_endless_run, objects


@both_modes
def test_ctrl_c_ends_a_run_cleanly(folder, mode):
    done = interrupt_endless_run(folder, "--mode", mode, "--json")
    assert done.returncode == 130
    (run,) = objects(done.stdout)
    assert run["interrupted"]
    assert 0 < run["sim_time_s"] < 9_000_000
    assert "Traceback" not in done.stderr


@both_modes
def test_a_second_ctrl_c_leaves_a_protocol_that_never_returns(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Stuck", "--mode", mode, "--json")
    assert done.returncode == 130
    (run,) = objects(done.stdout)
    assert (run["interrupted"], run["sim_time_s"]) == (True, 1.0)
    line = PROTOCOL.splitlines().index("            signal.raise_signal(signal.SIGINT)") + 1
    assert f'protocol.py", line {line}, ' in done.stderr
    assert "(Stuck 0) at 1 s " in done.stderr


@both_modes
def test_ctrl_c_stops_at_once_what_is_still_being_built(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "StuckInTheMaking", "--mode", mode)
    assert (done.returncode, done.stdout) == (130, "")
    assert "Traceback" not in done.stderr


@both_modes
def test_ctrl_c_as_a_run_comes_to_its_end_begins_no_other(gradysim, folder, mode):
    protocol = "import os\nfrom protocol import Quiet\nclass Last(Quiet):\n    def finish(self):\n"
    stop = f"        self.provider.get_id() or os.kill({os.getpid()}, 2)\n"
    (folder / "last.py").write_text(protocol + stop)
    name = ("--set", "*.uavs[*].protocol.class=last.py:Last")
    done = gradysim("run", "test.ini", "--mode", mode, "--json", *name)
    assert done.returncode == 130
    assert [run["interrupted"] for run in objects(done.stdout)] == [False]


def test_ctrl_c_stops_at_once_several_runs_that_are_still_being_built(gradysim):
    done = gradysim("run", "test.ini", "-c", "StuckInTheMaking", "--mode", "prototype", "-j", "2")
    assert (done.returncode, done.stdout) == (130, "")
    assert "Traceback" not in done.stderr


def test_ctrl_c_stops_at_once_what_is_still_being_read(folder, gradysim):
    (folder / "long.py").write_text("import signal\nsignal.raise_signal(signal.SIGINT)\n", encoding="utf-8")
    done = gradysim("run", "test.ini", "--set", "*.uavs[*].protocol.class=long.py:Long")
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")


@both_modes
def test_the_summary_of_an_interrupted_run_says_so(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Stuck", "--mode", mode, "-r", "0")
    assert "at 1 s " in done.stdout
