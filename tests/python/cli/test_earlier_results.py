"""`gradysim run` into a directory with results: it replaces only outdated or incomplete ones."""

import contextlib
import errno
import fcntl
import json
import os
import signal
import subprocess
import sys
import time

import pytest

from gradysim.cli.earlier_results import runs_to_do
from gradysim.cli.options import RunOptions
from gradysim.cli.runs import check
from gradysim.execution.run_lock import LOCK_FILE
from gradysim.results.durable import finished_name
from python.cli.command import both_modes, compiled, environment, objects

RUN = ("run", "test.ini", "--mode", "prototype", "--quiet")
OTHER_LIMIT = ("--set", "sim-time-limit=2s")


def content(directory):
    return {path.name: path.read_bytes() for path in directory.iterdir() if not finished_name(path.name)}


@pytest.fixture
def out(gradysim, folder):
    """Return a directory with the results of three runs."""
    gradysim(*RUN, "--result-dir", "out")
    return folder / "out"


@pytest.mark.parametrize(
    "other", [OTHER_LIMIT, ("--seed", "7"), ("--set", "repeat=4", "--set", "seed-set=5")]
)
@pytest.mark.parametrize("resume", [(), ("--resume",)])
def test_results_of_other_settings_are_refused_before_anything_runs(gradysim, out, other, resume):
    before = content(out)
    done = gradysim(*RUN, "--result-dir", "out", "--json", *other, *resume)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.splitlines()[-1].startswith("--result-dir out: ")
    for part in (" 3 of ", "(0..2)", "--replace"):
        assert part in done.stderr
    assert content(out) == before


@pytest.mark.parametrize("files", [("--scalars",), ("--vectors", "all"), ("--replay", "all")])
def test_other_files_do_not_join_results_of_other_settings(gradysim, out, files):
    out.rename(out.with_name("results"))
    done = gradysim(*RUN, *OTHER_LIMIT, *files)
    assert done.returncode == 2
    assert {path.suffix for path in out.with_name("results").iterdir()} == {".json"}


def test_runs_that_write_nothing_are_not_refused(gradysim, out):
    out.rename(out.with_name("results"))
    assert gradysim(*RUN, *OTHER_LIMIT).returncode == 0


def test_they_are_replaced_on_request_with_a_line_about_it(gradysim, out):
    done = gradysim(*RUN, "--result-dir", "out", *OTHER_LIMIT, "--replace")
    assert done.returncode == 0
    (line,) = done.stderr.splitlines()
    assert line.startswith("General: --replace: ")
    assert "(0..2)" in line
    assert {json.loads(text)["sim_time_s"] for text in content(out).values()} == {2}


@compiled
def test_their_captures_and_replays_do_not_stay_beside_the_new_results(gradysim, folder):
    command = ("run", "test.ini", "-r", "0", "--result-dir", "out")
    gradysim(*command, "--pcap", "all", "--replay", "all")
    done = gradysim(*command, *OTHER_LIMIT, "--replace")
    assert list(content(folder / "out")) == ["General-#0.integrated.json"]
    assert "out/General-#0.integrated.html" in done.stdout


def test_a_second_run_with_the_same_settings_replaces_the_first(gradysim, out):
    before = content(out)
    assert gradysim(*RUN, "--result-dir", "out").returncode == 0
    assert content(out).keys() == before.keys()
    assert content(out) != before  # their wall times differ


def test_ten_thousand_runs_are_looked_for_without_reading_them(folder, monkeypatch):
    study = check(folder / "test.ini", "General", None, ["repeat = 10000"])
    made = []
    monkeypatch.setattr(type(study), "__getitem__", lambda _, place: made.append(place))
    runs_to_do(study, RunOptions(result_dir=folder / "out"))
    assert made == []


PROTOCOLS = """
import os
import time
from protocol import Talker

COMMAND = os.getpid()  # which imports this module

class StopsInTheMiddle(Talker):
    def handle_timer(self, timer):
        if os.path.exists("stop") and self.provider.current_time() > 5:
            os.remove("stop")
            STOP
        super().handle_timer(timer)

class Waits(Talker):
    def initialize(self):
        super().initialize()
        if self.provider.get_id() == 0:
            with open("began", "a") as file:
                print(self.provider.run_name, file=file)
            open("pipe").close()
"""

ALL_FILES = ("--result-dir", "out", "--scalars", "--vectors", "all", "--replay", "all")


@both_modes
@pytest.mark.parametrize(
    ("stop", "code"),
    [
        ('raise RuntimeError("spoilt")', 1),
        ("os.kill(COMMAND, 2); time.sleep(0.2)", 130),
        ("os.kill(COMMAND, 15); time.sleep(0.2)", 143),
        ("os._exit(3)", 1),
        ("os.kill(os.getpid(), 9)", 1),
    ],
)
@pytest.mark.parametrize("new", [(), ("--replace", "--set", "sim-time-limit=200s")])
def test_an_incomplete_result_never_replaces_a_complete_one(gradysim, folder, mode, stop, code, new):
    (folder / "stops.py").write_text(PROTOCOLS.replace("STOP", stop))
    name = ("--set", '*.uavs[*].protocol.class="stops.py:StopsInTheMiddle"')
    files = (*ALL_FILES, *(["--pcap", "uavs[0]"] if mode == "integrated" else []))
    command = ("run", "test.ini", "--mode", mode, "--quiet", "-r", "0", *name, *files)
    long = ("--set", "sim-time-limit=300s")
    assert gradysim(*command, *long).returncode == 0
    before = content(folder / "out")
    (folder / "stop").touch()
    done = gradysim(*command, *(new or long))
    assert done.returncode == code
    assert content(folder / "out") == before
    assert "(0)" in gradysim(*command, *long, "--resume").stderr


def test_an_incomplete_result_replaces_an_incomplete_one(gradysim, folder):
    (folder / "stops.py").write_text(PROTOCOLS.replace("STOP", 'raise RuntimeError("spoilt")'))
    (folder / "stop").touch()
    command = (*RUN, "-r", "0", *ALL_FILES, "--set", '*.uavs[*].protocol.class="stops.py:StopsInTheMiddle"')
    gradysim(*command)
    before = content(folder / "out")
    (folder / "stop").touch()
    gradysim(*command)
    after = content(folder / "out")
    assert after.keys() == before.keys()
    assert after["General-#0.prototype.json"] != before["General-#0.prototype.json"]


@contextlib.contextmanager
def begun(folder, *arguments):
    """Start a command whose protocols wait until the pipe is opened for writing."""
    (folder / "stops.py").write_text(PROTOCOLS)
    os.mkfifo(folder / "pipe")
    with subprocess.Popen(
        [sys.executable, "-m", "gradysim", *RUN, *arguments],
        cwd=folder,
        env=environment(),
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        while not (folder / "began").exists():
            assert process.poll() is None
            time.sleep(0.01)
        yield process
        process.kill()


@pytest.fixture
def other_command(folder):
    """Return a command that computes run 0, and waits in it until the pipe is opened for writing."""
    with begun(folder, "-r", "0", *WAITING) as process:
        yield process


WAITING = ("--set", '*.uavs[*].protocol.class="stops.py:Waits"', "--result-dir", "out")


def let_it_go_on(folder):
    (folder / "pipe").open("w").close()


def test_a_run_that_another_process_computes_is_left_out(gradysim, folder, other_command):
    done = gradysim(*RUN, "-r", "0", "--json", *WAITING)
    assert (done.returncode, done.stdout) == (3, "")
    assert f" {worker_of(other_command)} " in done.stderr
    assert (folder / "began").read_text() == "General-#0.prototype\n"
    let_it_go_on(folder)
    assert other_command.wait(20) == 0
    assert [path.name for path in (folder / "out").iterdir()] == ["General-#0.prototype.json"]


def worker_of(command):
    """Return the process of the only run: the child of its guardian."""
    pid = command.pid
    for _ in range(2):
        with open(f"/proc/{pid}/task/{pid}/children") as file:
            pid = int(file.read())
    return pid


def test_the_others_are_done(gradysim, folder, other_command):
    quick = ("--set", '*.uavs[*].protocol.class="protocol.py:Talker"', "--result-dir", "out")
    done = gradysim(*RUN, "--json", *quick)
    assert done.returncode == 3
    assert [run["run"] for run in objects(done.stdout)] == [1, 2]
    assert done.stderr.endswith(" (1..2)\n")


def test_a_lock_ends_with_a_killed_process_and_so_do_its_files(gradysim, folder, other_command):
    left_over = folder / "out" / f"General-#0.prototype.json.{worker_of(other_command)}"
    left_over.touch()
    quick = ("--set", '*.uavs[*].protocol.class="protocol.py:Talker"', "--result-dir", "out")
    gradysim(*RUN, "-r", "1", *quick)
    assert left_over.exists()
    assert (folder / "out" / LOCK_FILE).exists()
    other_command.send_signal(signal.SIGKILL)
    other_command.wait()
    while gradysim(*RUN, "-r", "0", *quick).returncode == 3:  # the kernel is about to kill its worker
        time.sleep(0.01)
    assert sorted(content(folder / "out")) == ["General-#0.prototype.json", "General-#1.prototype.json"]


def test_a_replay_that_is_removed_while_it_grows_is_an_error(gradysim, folder):
    replay = ("-r", "0", "--replay", "all")
    gradysim(*RUN, *replay, "--result-dir", "out")
    with begun(folder, *replay, "--replace", *WAITING) as process:
        (page,) = (folder / "out").glob("*.html.*")
        page.unlink()
        let_it_go_on(folder)
        _, err = process.communicate(timeout=20)
    assert process.returncode == 2
    assert err.splitlines()[-1].startswith(f"{page.relative_to(folder)}: ")
    (result,) = content(folder / "out").values()
    assert json.loads(result)["output_hashes"] == {}


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_without_locks_there_is_one_warning_and_all_runs_are_done(gradysim, folder, monkeypatch, jobs):
    def lockf(*_):
        raise OSError(errno.ENOLCK, "no locks")

    monkeypatch.setattr(fcntl, "lockf", lockf)
    done = gradysim(*RUN, "--result-dir", "out", "--jobs", jobs)
    assert done.returncode == 0
    (line,) = done.stderr.splitlines()
    assert line.startswith("out: ")
    assert len([name for name in content(folder / "out") if name.endswith(".json")]) == 3
