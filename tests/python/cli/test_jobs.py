"""`gradysim run --jobs`: several runs at once."""

import os
import select
import signal
import subprocess
import sys

import pytest

from gradysim.cli.app import main
from python.cli.command import both_modes, environment, objects, run_command

COSTS = ("wall_s", "cpu_s", "setup_s")

TELLS = """
import os
import signal
import sys

from protocol import Talker


class Endless(Talker):
    def initialize(self):
        super().initialize()
        if self.provider.get_id() == 0:
            self.pipe = os.open("pipe", os.O_WRONLY)
            os.write(self.pipe, b"ready\\n")


class Killed(Talker):
    def handle_timer(self, timer):
        print("the last line")
        print("the last error", file=sys.stderr)
        os.kill(os.getpid(), 9)


class PrintsWhatIsNoText(Talker):
    def handle_timer(self, timer):
        print("half of a pair: \\ud800")
        os.write(1, b"half of a letter: \\xc3\\n")


class EndsItself(Talker):
    status = 0

    def handle_timer(self, timer):
        os._exit(self.status)


class PressesCtrlCUntilItEnds(Talker):
    def handle_timer(self, timer):
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
        command = os.getppid()
        while os.getppid() == command:
            os.kill(command, signal.SIGINT)
            signal.sigtimedwait([signal.SIGINT], 10)


class WaitsForTheLast(Talker):
    number = 0
    last = 0

    def initialize(self):
        super().initialize()
        if self.provider.get_id() == 0 and self.number in (0, self.last):
            open("pipe", "r" if self.number == 0 else "w").close()


class PressesCtrlCAtItsEnd(WaitsForTheLast):
    last = 1

    def initialize(self):
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])  # which is passed on to all runs
        super().initialize()

    def finish(self):
        if self.provider.get_id() == 0:
            os.kill(os.getppid(), signal.SIGINT)
"""


def without_costs(output):
    return [{key: value for key, value in run.items() if key not in COSTS} for run in objects(output)]


@both_modes
def test_results_are_those_of_runs_in_turn_and_in_their_order(gradysim, mode):
    arguments = ("run", "test.ini", "--mode", mode, "--json", "--set", "repeat=5")
    in_turn, at_once = gradysim(*arguments), gradysim(*arguments, "--jobs", "3")
    assert at_once.returncode == 0
    assert without_costs(at_once.stdout) == without_costs(in_turn.stdout)
    assert at_once.stderr.count("printed by a protocol") == 2 * 5


def test_files_of_results_are_written(gradysim, folder):
    done = gradysim("run", "test.ini", "--mode", "prototype", "-j", "2", "--result-dir", "out")
    assert (done.returncode, done.stderr) == (0, "")
    assert len(list((folder / "out").iterdir())) == 3
    shown = [line.split()[2] for line in done.stdout.splitlines() if line.startswith("General run")]
    assert shown == ["0", "1", "2"]


def test_after_a_failure_no_run_is_begun(gradysim):
    done = gradysim("run", "test.ini", "-c", "Failing", "--mode", "prototype", "--quiet", "-j", "2")
    assert done.returncode == 1
    assert "RuntimeError: spoilt" in done.stderr
    last = done.stderr.splitlines()[-1]
    assert last == "Failing: run 0 failed, run 1 failed, 0 of 3 runs are done, 1 was not begun (2)"


def test_a_mistake_that_only_a_run_shows_is_told(gradysim, folder):
    (folder / "out").mkdir()
    (folder / "out" / "General-#0.prototype.json").mkdir()
    done = gradysim("run", "test.ini", "--mode", "prototype", "-j", "2", "--result-dir", "out")
    assert done.returncode == 2
    assert "General-#0.prototype.json" in done.stderr
    assert "General: run 0 failed" in done.stderr


def test_an_interrupted_process_ends_all(gradysim):
    done = gradysim("run", "test.ini", "-c", "Stuck", "--mode", "prototype", "--json", "-j", "2")
    assert done.returncode == 130
    assert [run["interrupted"] for run in objects(done.stdout)] == [True, True]
    last = done.stderr.splitlines()[-1]
    assert last.startswith("Stuck: run 0 was interrupted, run 1 was interrupted, 0 of 3 runs are done")


def test_a_process_that_is_killed_is_told(gradysim, folder):
    (folder / "tells.py").write_text(TELLS)
    name = '*.uavs[*].protocol.class="tells.py:Killed"'
    done = gradysim("run", "test.ini", "--mode", "prototype", "-j", "2", "-r", "0,2", "--set", name)
    assert done.returncode == 1
    for run in (0, 2):
        assert f"General run {run}: its process was ended by SIGKILL, and left no result\n" in done.stderr
    assert "General: run 0 failed, run 2 failed, 0 of 2 runs are done\n" in done.stderr
    assert (done.stdout.count("the last line\n"), done.stderr.count("the last error\n")) == (2, 2)


def test_what_is_no_text_is_printed_in_another_way(gradysim, folder):
    (folder / "tells.py").write_text(TELLS)
    name = '*.uavs[*].protocol.class="tells.py:PrintsWhatIsNoText"'
    done = gradysim("run", "test.ini", "--mode", "prototype", "-r", "0,1", "-j", "2", "--set", name)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.count("half of a pair: \\ud800\n") == 4
    assert done.stdout.count("half of a letter: \N{REPLACEMENT CHARACTER}\n") == 4


@pytest.mark.parametrize("status", [0, 3])
def test_a_process_that_ends_itself_is_no_run_that_is_done(gradysim, folder, status):
    (folder / "tells.py").write_text(TELLS)
    settings = ('class="tells.py:EndsItself"', f"status={status}")
    arguments = [part for line in settings for part in ("--set", f"*.uavs[*].protocol.{line}")]
    done = gradysim("run", "test.ini", "--mode", "prototype", "-j", "2", "-r", "1,2", "--json", *arguments)
    assert (done.returncode, done.stdout) == (1, "")
    for run in (1, 2):
        assert (
            f"General run {run}: its process ended with exit status {status}, as by os._exit,"
            " and left no result\n" in done.stderr
        )
    assert done.stderr.endswith("General: run 1 failed, run 2 failed, 0 of 2 runs are done\n")


def test_an_exception_outside_of_protocols_is_not_told_as_an_exit(folder):
    code = (
        "import sys; from gradysim.cli.app import main; from gradysim.cli import summary\n"
        "def print_summary(*_): raise RuntimeError('no summary')\n"
        "summary.print_summary = print_summary\n"
        "sys.exit(main(['run', 'test.ini', '--mode', 'prototype', '-r', '0', '-j', '2']))"
    )
    done = run_command(folder, sys.executable, "-c", code)
    assert done.returncode == 1
    assert done.stderr.splitlines()[-2:] == [
        "RuntimeError: no summary",
        "General run 0: its process ended with that exception, and left no result",
    ]


def test_a_process_that_cannot_begin_is_told(folder):
    code = (
        "import errno, os, sys; from gradysim.cli.app import main\n"
        "def fork(count=[]):\n"
        "    count.append(1)\n"
        "    if len(count) > 1: raise OSError(errno.EAGAIN, 'too many processes')\n"
        "    return real_fork()\n"
        "real_fork, os.fork = os.fork, fork\n"
        "sys.exit(main(['run', 'test.ini', '--mode', 'prototype', '--json', '-j', '2']))"
    )
    done = run_command(folder, sys.executable, "-c", code)
    assert done.returncode == 2
    assert [run["run"] for run in objects(done.stdout)] == [0]
    assert done.stderr.splitlines()[-2:] == [
        "General run 1: its process cannot begin: too many processes",
        "General: run 1 failed, 1 of 3 runs is done (0), 1 was not begun (2)",
    ]


def test_many_runs_may_end_before_the_first_one_does(folder):
    (folder / "tells.py").write_text(TELLS)
    os.mkfifo(folder / "pipe")
    lines = ('class="tells.py:WaitsForTheLast"', "number=${runnumber}", "last=39")
    settings = [part for line in lines for part in ("--set", f"*.uavs[*].protocol.{line}")]
    few_files = ["sh", "-c", 'ulimit -n 60 && exec "$@"', "sh"]
    arguments = ["test.ini", "--mode", "prototype", "--json", "-j", "2", "--set", "repeat=40"]
    done = run_command(folder, *few_files, sys.executable, "-m", "gradysim", "run", *arguments, *settings)
    assert done.returncode == 0
    assert [run["run"] for run in objects(done.stdout)] == list(range(40))


@pytest.mark.parametrize("jobs", ["0", "-1"])
def test_there_is_a_job_at_least(gradysim, folder, jobs):
    done = gradysim("run", "test.ini", "--mode", "prototype", "--result-dir", "out", f"--jobs={jobs}")
    assert done.returncode == 2
    assert done.stderr == f"--jobs {jobs}: it is out of range; expected 1 or more\n"
    assert not (folder / "out").exists()


def test_a_system_that_cannot_fork_has_one_job(folder, monkeypatch, capsys):
    monkeypatch.delattr(os, "fork")
    monkeypatch.chdir(folder)
    assert main(["run", "test.ini", "--mode", "prototype", "--json", "-j", "2"]) == 2
    told = "--jobs 2: this system cannot divide a process into two; expected --jobs 1\n"
    assert capsys.readouterr() == ("", told)


@pytest.fixture
def two_endless_runs(folder):
    """The command with two processes that have begun, and what ends when they do."""
    (folder / "tells.py").write_text(TELLS)
    os.mkfifo(folder / "pipe")
    arguments = ["test.ini", "-c", "Endless", "--mode", "prototype", "--json", "-j", "2"]
    setting = ["--set", '*.uavs[*].protocol.class="tells.py:Endless"']
    with subprocess.Popen(
        [sys.executable, "-m", "gradysim", "run", *arguments, *setting],
        cwd=folder,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        with (folder / "pipe").open("rb", buffering=0) as pipe:
            text = b""
            while text.count(b"ready") < 2:
                more = pipe.read(100)
                assert more, "they ended before they were ready"
                text += more
            yield process, pipe
        process.kill()


def test_ctrl_c_ends_all_runs_under_way(two_endless_runs):
    process, _ = two_endless_runs
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=20)
    assert process.returncode == 130
    assert [(run["run"], run["interrupted"]) for run in objects(out)] == [(0, True), (1, True)]
    assert err.count("stopping after this step") == 1
    assert err.splitlines()[-1] == (
        "Endless: run 0 was interrupted, run 1 was interrupted, 0 of 3 runs are done, 1 was not begun (2)"
    )


def test_after_ctrl_c_no_run_is_begun_even_if_those_under_way_come_to_their_end(gradysim, folder):
    (folder / "tells.py").write_text(TELLS)
    os.mkfifo(folder / "pipe")
    lines = ('class="tells.py:PressesCtrlCAtItsEnd"', "number=${runnumber}")
    settings = [part for line in lines for part in ("--set", f"*.uavs[*].protocol.{line}")]
    done = gradysim("run", "test.ini", "--mode", "prototype", "--json", "-j", "2", *settings)
    assert done.returncode == 130
    assert done.stderr.endswith("General: 2 of 3 runs are done (0..1), 1 was not begun (2)\n")


def test_the_third_ctrl_c_ends_a_protocol_that_takes_no_notice(gradysim, folder):
    (folder / "tells.py").write_text(TELLS)
    name = '*.uavs[*].protocol.class="tells.py:PressesCtrlCUntilItEnds"'
    done = gradysim("run", "test.ini", "--mode", "prototype", "-r", "0", "-j", "2", "--set", name)
    assert (done.returncode, done.stdout) == (130, "")
    assert done.stderr == "\nstopping after this step; Ctrl-C once more stops at once\n"


def test_who_is_killed_leaves_nobody_behind(two_endless_runs):
    process, pipe = two_endless_runs
    process.kill()
    readable, _, _ = select.select([pipe], [], [], 20)
    assert (readable, pipe.read(100)) == ([pipe], b"")
