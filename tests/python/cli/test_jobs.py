"""`gradysim run --jobs`: several runs at the same time."""

import errno
import os
import select
import signal
import subprocess
import sys

import pytest

from gradysim.cli import single_run
from python.cli.command import both_modes, deaths, environment, objects, run_command

COSTS = ("wall_s", "cpu_s", "setup_s")

TELLS = """
import os
import signal
import sys

from protocol import Talker

COMMAND = os.getpid()  # which imports this module


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
        if self.status >= 0:
            os._exit(self.status)


class PressesCtrlCUntilItEnds(Talker):
    def handle_timer(self, timer):
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGUSR1])  # which passes it on
        while True:
            os.kill(COMMAND, signal.SIGINT)
            signal.sigtimedwait([signal.SIGUSR1], 10)


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
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGUSR1])  # which passes it on to all runs
        super().initialize()

    def finish(self):
        if self.provider.get_id() == 0:
            os.kill(COMMAND, signal.SIGINT)
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
    assert "spoilt" in done.stderr
    assert done.stderr.endswith(" (2)\n")


def test_a_mistake_that_only_a_run_shows_is_told(gradysim, folder):
    (folder / "out").mkdir()
    (folder / "out" / "General-#0.prototype.json").mkdir()
    done = gradysim("run", "test.ini", "--mode", "prototype", "-j", "2", "--result-dir", "out")
    assert done.returncode == 2
    assert "General-#0.prototype.json" in done.stderr
    assert "run 0 " in done.stderr


def test_an_interrupted_process_ends_all(gradysim):
    done = gradysim("run", "test.ini", "-c", "Stuck", "--mode", "prototype", "--json", "-j", "2")
    assert done.returncode == 130
    assert [run["interrupted"] for run in objects(done.stdout)] == [True, True]
    assert done.stderr.endswith(" (2)\n")


def test_a_process_that_is_killed_is_told(gradysim, folder):
    (folder / "tells.py").write_text(TELLS)
    name = '*.uavs[*].protocol.class="tells.py:Killed"'
    done = gradysim("run", "test.ini", "--mode", "prototype", "-j", "2", "--set", name)
    assert done.returncode == 1
    assert deaths(done.stderr) == {0: "SIGKILL", 1: "SIGKILL", 2: "SIGKILL"}
    assert (done.stdout.count("the last line\n"), done.stderr.count("the last error\n")) == (3, 3)


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_the_others_go_on_when_a_process_dies(gradysim, folder, jobs):
    (folder / "tells.py").write_text(TELLS)
    lines = ('class="tells.py:EndsItself"', "status=${status=0, -1, 3, -1}")
    settings = [part for line in lines for part in ("--set", f"*.uavs[*].protocol.{line}")]
    arguments = ("--mode", "prototype", "--jobs", jobs, "--result-dir", "out", "--set", "repeat=1")
    done = gradysim("run", "test.ini", *arguments, *settings)
    assert done.returncode == 1
    files = sorted(path.name for path in (folder / "out").iterdir())
    assert files == ["General-#1.prototype.json", "General-#3.prototype.json"]
    assert deaths(done.stderr) == {0: "0", 2: "3"}


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
    assert deaths(done.stderr) == {1: str(status), 2: str(status)}


def test_an_exception_outside_of_protocols_is_told_with_its_traceback(gradysim, monkeypatch):
    def print_summary(*_, **__):
        raise RuntimeError("no summary")

    monkeypatch.setattr(single_run, "print_summary", print_summary)
    done = gradysim("run", "test.ini", "--mode", "prototype", "-r", "0", "-j", "2")
    assert done.returncode == 1
    assert "RuntimeError" in done.stderr
    assert deaths(done.stderr) == {0: "1"}


@pytest.mark.parametrize("fails_in", ["command", "guardian"])
def test_a_process_that_cannot_start_is_told(gradysim, monkeypatch, fails_in):
    command, forks, real_fork = os.getpid(), [], os.fork

    def fork():
        process = "command" if os.getpid() == command else "guardian"
        if process == "command":
            forks.append(process)
        if len(forks) == 2 and process == fails_in:
            raise OSError(errno.EAGAIN, "too many processes")
        return real_fork()

    monkeypatch.setattr(os, "fork", fork)
    done = gradysim("run", "test.ini", "--mode", "prototype", "--json", "-j", "2")
    assert done.returncode == 2
    assert [run["run"] for run in objects(done.stdout)] == [0]
    assert deaths(done.stderr) == {1: "processes"}


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
    assert done.stderr.startswith(f"--jobs {jobs}: ")
    assert not (folder / "out").exists()


def test_a_system_that_cannot_fork_has_one_job(gradysim, monkeypatch):
    monkeypatch.delattr(os, "fork")
    arguments = ("run", "test.ini", "--mode", "prototype", "--json", "-r", "0,2", "-j")
    refused, done = gradysim(*arguments, "2"), gradysim(*arguments, "1")
    assert (refused.returncode, refused.stdout) == (2, "")
    assert done.returncode == 0
    assert [run["run"] for run in objects(done.stdout)] == [0, 2]


@pytest.fixture
def two_endless_runs(folder):
    """Return the command with two running processes, and a handle that ends when they do."""
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
    assert err.count("stopping") == 1
    assert err.endswith(" (2)\n")


def test_after_ctrl_c_no_run_is_begun_even_if_those_under_way_come_to_their_end(gradysim, folder):
    (folder / "tells.py").write_text(TELLS)
    os.mkfifo(folder / "pipe")
    lines = ('class="tells.py:PressesCtrlCAtItsEnd"', "number=${runnumber}")
    settings = [part for line in lines for part in ("--set", f"*.uavs[*].protocol.{line}")]
    done = gradysim("run", "test.ini", "--mode", "prototype", "--json", "-j", "2", *settings)
    assert done.returncode == 130
    assert [run["interrupted"] for run in objects(done.stdout)] == [False, False]


def test_the_third_ctrl_c_ends_a_protocol_that_takes_no_notice(gradysim, folder):
    (folder / "tells.py").write_text(TELLS)
    name = '*.uavs[*].protocol.class="tells.py:PressesCtrlCUntilItEnds"'
    done = gradysim("run", "test.ini", "--mode", "prototype", "-r", "0", "-j", "2", "--set", name)
    assert (done.returncode, done.stdout) == (130, "")
    assert "Traceback" not in done.stderr


def test_who_is_killed_leaves_nobody_behind(two_endless_runs):
    process, pipe = two_endless_runs
    process.kill()
    readable, _, _ = select.select([pipe], [], [], 20)
    assert (readable, pipe.read(100)) == ([pipe], b"")
