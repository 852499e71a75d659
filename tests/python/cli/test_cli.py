"""The command as a user meets it: a process with arguments, output and an exit code."""

import json
import os
import pty
import signal
import subprocess
import sys
from collections.abc import Callable
from importlib import util
from pathlib import Path

import pytest

PROTOCOL = """
import signal
import sys
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand

class Quiet(IProtocol):
    def initialize(self): pass
    def handle_timer(self, timer): pass
    def handle_packet(self, message): pass
    def handle_telemetry(self, telemetry): pass
    def finish(self): pass

class Talker(Quiet):
    def initialize(self):
        print("printed by a protocol")
        self.provider.tracked_variables["said"] = 0
        self.provider.schedule_timer("talk", 1 + 0.01 * self.provider.get_id())
    def handle_timer(self, timer):
        self.provider.send_communication_command(BroadcastMessageCommand("hello"))
        self.provider.tracked_variables["said"] += 1
        self.provider.schedule_timer("talk", self.provider.current_time() + 1)

class Failing(Talker):
    def handle_packet(self, message):
        raise RuntimeError("spoilt")

class Endless(Talker):
    def initialize(self):
        super().initialize()
        print("ready", file=sys.stderr, flush=True)

class Stuck(Talker):
    def handle_timer(self, timer):
        while True:
            signal.raise_signal(signal.SIGINT)

class Unmakeable(Quiet):
    def __init__(self):
        raise RuntimeError("no constructor")
"""

INI = """[General]
sim-time-limit = 10.5s
repeat = 3
*.uavs.count = 2
*.uavs[*].protocol.class = "protocol.py:Talker"
*.uavs[*].mobility.lineStepX = 10m
*.uavs[*].mobility.telemetryInterval = 0s

[Config Failing]
*.uavs[*].protocol.class = "protocol.py:Failing"

[Config Endless]
sim-time-limit = 2500h
*.uavs[*].protocol.class = "protocol.py:Endless"
*.uavs[*].mobility.telemetryInterval = 0.1s

[Config Stuck]
*.uavs[*].protocol.class = "protocol.py:Stuck"

[Config Unmakeable]
*.uavs[*].protocol.class = "protocol.py:Unmakeable"

[Config Chatty]
*.uavs[*].protocol.class = "chatty.py:Talker"

[Config LateMistake]
*.uavs[*].wlan[*].mac.dcf.channelAccess.cwMin = 20000 * ${runnumber}
*.uavs[*].mobility.telemetryInterval = ${runnumber}ms

[Config WrongKey]
*.uavs[*].mobility.sped = 3mps
"""

LINE_OF_THE_WRONG_KEY = INI.splitlines().index("*.uavs[*].mobility.sped = 3mps") + 1

compiled = pytest.mark.skipif(
    util.find_spec("gradysim._netsim") is None, reason="the compiled part is not installed"
)
both_modes = pytest.mark.parametrize("mode", [pytest.param("integrated", marks=compiled), "prototype"])

Gradysim = Callable[..., subprocess.CompletedProcess[str]]


def environment():
    return {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "COLUMNS": "100"}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "protocol.py").write_text(PROTOCOL, encoding="utf-8")
    (tmp_path / "chatty.py").write_text(PROTOCOL + "print('printed by a module')", encoding="utf-8")
    (tmp_path / "test.ini").write_text(INI, encoding="utf-8")
    return tmp_path


@pytest.fixture
def gradysim(folder: Path) -> Gradysim:
    """`gradysim(*arguments)` runs the command in the folder with test.ini."""

    def run(*arguments: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-m", "gradysim", *arguments],
            cwd=folder,
            env=environment(),
            capture_output=True,
            text=True,
            timeout=60,
        )

    return run


def objects(output: str) -> list[dict]:
    return [json.loads(line) for line in output.splitlines()]


# --- Help and version ---


def test_help_names_the_commands(gradysim):
    done = gradysim("--help")
    assert done.returncode == 0
    assert "run " in done.stdout
    assert "runs " in done.stdout


def test_help_of_run_names_its_options(gradysim):
    text = gradysim("run", "--help").stdout
    for option in ("--config", "-c", "--runs", "-r", "--mode", "--set", "--result-dir", "--json", "--quiet"):
        assert option in text


def test_help_loads_nothing_heavy(folder):
    code = "import sys; from gradysim.cli import main; main(['--help']); print(*sys.modules, sep='\\n')"
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment(), capture_output=True, text=True, check=True
    )
    ours = {name for name in done.stdout.splitlines() if name.startswith("gradysim")}
    assert ours == {"gradysim", "gradysim.cli"}
    heavy = {"numpy", "pandas", "matplotlib", "sqlite3", "asyncio", "rich.progress"}
    assert not heavy & set(done.stdout.splitlines())


def test_version(gradysim):
    done = gradysim("--version")
    assert done.returncode == 0
    assert done.stdout.strip()


# --- A run ---


@both_modes
def test_the_summary(gradysim, mode):
    done = gradysim("run", "test.ini", "--mode", mode, "-r", "1")
    assert done.returncode == 0, done.stderr
    for text in ("General run 1", "seed 1", f"{mode} mode", "uavs[1]", "said = 10", "delivered", "10.5 s"):
        assert text in done.stdout
    assert done.stderr == ""


@compiled
def test_integrated_is_the_default(gradysim):
    assert "integrated mode" in gradysim("run", "test.ini", "-r", "0").stdout


def test_all_runs_are_the_default(gradysim):
    done = gradysim("run", "test.ini", "--mode", "prototype", "--json")
    assert [run["run"] for run in objects(done.stdout)] == [0, 1, 2]


def test_chosen_runs(gradysim):
    done = gradysim("run", "test.ini", "--mode", "prototype", "--json", "-r", "0,2")
    assert [run["run"] for run in objects(done.stdout)] == [0, 2]


@both_modes
def test_json_has_the_keys_that_scripts_rely_on(gradysim, mode):
    (run,) = objects(gradysim("run", "test.ini", "--mode", mode, "--json", "-r", "0").stdout)
    assert set(run) == {
        "config",
        "run",
        "seed",
        "mode",
        "sim_time_s",
        "wall_s",
        "cpu_s",
        "events",
        "interrupted",
        "fingerprint",
        "fates",
        "nodes",
    }
    assert set(run["nodes"][0]) == {"id", "name", "protocol", "position", "tracked_variables"}
    assert run["mode"] == mode
    assert run["nodes"][0]["tracked_variables"] == {"said": 10}


@pytest.mark.parametrize("origin", ["protocol", "module"])
def test_what_protocols_print_is_kept_out_of_the_json(gradysim, origin):
    done = gradysim("run", "test.ini", "-c", "Chatty", "--mode", "prototype", "--json", "-r", "0")
    assert len(done.stdout.splitlines()) == 1
    assert f"printed by a {origin}" in done.stderr


def test_set_comes_before_the_file(gradysim):
    done = gradysim(
        "run", "test.ini", "--mode", "prototype", "--json", "-r", "0",
        "--set", "sim-time-limit=5s", "--set", "*.uavs.count = 3",
    )  # fmt: skip
    (run,) = objects(done.stdout)
    assert (run["sim_time_s"], len(run["nodes"])) == (5.0, 3)


def test_the_seed_of_the_first_run_counts_on_in_the_next(gradysim):
    done = gradysim("run", "test.ini", "--mode", "prototype", "--seed", "40", "-r", "0,2", "--json")
    assert [run["seed"] for run in objects(done.stdout)] == [40, 42]


@pytest.mark.parametrize(
    ("runs", "seed", "warned"), [("0..2", 4, True), ("1", 4, False), ("0..2", None, False)]
)
def test_runs_with_one_seed_are_warned_of(gradysim, runs, seed, warned):
    fixed = () if seed is None else ("--set", f"seed-set={seed}")
    done = gradysim("run", "test.ini", "--mode", "prototype", "--json", "-r", runs, *fixed)
    assert done.returncode == 0
    assert ("warning: the 3 runs of General have seed 4" in done.stderr) is warned


def test_a_negative_seed_is_refused(gradysim):
    done = gradysim("run", "test.ini", "--seed=-1")
    assert (done.returncode, done.stderr.strip()) == (2, "--seed -1: expected 0 or more")


def test_the_result_directory(gradysim, folder):
    done = gradysim("run", "test.ini", "--mode", "prototype", "-r", "0,2", "--result-dir", "out/here")
    assert sorted(path.name for path in (folder / "out" / "here").iterdir()) == [
        "General-#0.prototype.json",
        "General-#2.prototype.json",
    ]
    assert "General-#2.prototype.json" in done.stdout
    assert json.loads((folder / "out" / "here" / "General-#2.prototype.json").read_text())["run"] == 2


def test_a_result_directory_that_is_a_file_is_named_with_its_option(gradysim):
    done = gradysim("run", "test.ini", "--mode", "prototype", "--result-dir", "test.ini")
    expected = "--result-dir test.ini: it is a file; expected a folder, or a new name"
    assert (done.returncode, done.stderr.strip()) == (2, expected)


@pytest.mark.parametrize("arguments", [["keys"], ["run", "test.ini", "--mode", "prototype", "--json"]])
def test_a_reader_that_has_had_enough_ends_it_silently(folder, arguments):
    theirs, ours = os.pipe()
    os.close(theirs)
    done = subprocess.run(
        [sys.executable, "-m", "gradysim", *arguments],
        cwd=folder,
        env=environment(),
        stdout=ours,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
    )
    os.close(ours)
    assert [line for line in done.stderr.splitlines() if line != "printed by a protocol"] == []


@compiled
def test_the_same_seed_gives_the_same_fingerprint_in_another_process(gradysim):
    first, again = (
        objects(gradysim("run", "test.ini", "--json", "-r", "0").stdout)[0]["fingerprint"] for _ in range(2)
    )
    assert first == again


def test_runs_lists_the_runs(gradysim):
    done = gradysim("runs", "test.ini", "-c", "Failing")
    assert done.returncode == 0
    assert done.stdout.splitlines() == [
        "Run 0: $repetition=0",
        "Run 1: $repetition=1",
        "Run 2: $repetition=2",
    ]


# --- The progress bar ---


@pytest.mark.parametrize(("options", "bar"), [((), True), (("--quiet",), False), (("--json",), False)])
def test_the_bar_is_for_terminals(folder, options, bar):
    ours, theirs = pty.openpty()
    with subprocess.Popen(
        [sys.executable, "-m", "gradysim", "run", "test.ini", "-r", "0", "--mode", "prototype", *options],
        cwd=folder,
        env={**environment(), "TERM": "xterm"},
        stdout=subprocess.PIPE,
        stderr=theirs,
        text=True,
    ) as process:
        os.close(theirs)
        shown = b""
        with os.fdopen(ours, "rb", buffering=0) as terminal:
            while chunk := read_terminal(terminal):
                shown += chunk
        process.communicate()
    assert (b"x real time" in shown or b"of 10 s" in shown) is bar


def read_terminal(terminal):
    try:
        return terminal.read(4096)
    except OSError:  # how Linux says that the other side has gone
        return b""


# --- Mistakes ---


def test_a_wrong_key_is_named_with_its_place(gradysim):
    done = gradysim("run", "test.ini", "-c", "WrongKey")
    assert done.returncode == 2
    assert f"test.ini:{LINE_OF_THE_WRONG_KEY}" in done.stderr
    assert "speed" in done.stderr
    assert "Traceback" not in done.stderr
    assert done.stdout == ""


@compiled
def test_a_value_that_the_engine_refuses_is_named_with_its_place(gradysim):
    done = gradysim("run", "test.ini", "--set", "*.uavs[*].wlan[*].bitrate = 7Mbps")
    assert done.returncode == 2
    assert "--set *.uavs[*].wlan[*].bitrate=7Mbps" in done.stderr
    assert "Traceback" not in done.stderr


@both_modes
def test_a_mistake_in_a_later_run_is_found_before_the_first_one(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "LateMistake", "--mode", mode)
    assert done.returncode == 2
    assert done.stdout == ""


@pytest.mark.parametrize(
    "arguments",
    [
        ["run"],
        ["run", "missing.ini"],
        ["run", "test.ini", "--mode", "other"],
        ["run", "test.ini", "-c", "Missing"],
        ["run", "test.ini", "-r", "x"],
        ["run", "test.ini", "-r", "7"],
        ["run", "test.ini", "--set", "nonsense"],
        ["run", "test.ini", "--nonsense"],
        ["run", "test.ini", "--result-dir", "test.ini"],
        ["runs", "missing.ini"],
        ["nonsense"],
    ],
)
def test_wrong_arguments(gradysim, arguments):
    done = gradysim(*arguments)
    assert done.returncode == 2
    assert done.stderr != ""
    assert "Traceback" not in done.stderr
    assert done.stdout == ""


def test_integrated_mode_without_the_compiled_part_says_how_to_get_it(folder):
    code = (
        "import sys; sys.modules['gradysim._netsim'] = None; from gradysim.cli import main; sys.exit(main())"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, "run", "test.ini"],
        cwd=folder, env=environment(), capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 2
    assert "pip install ." in done.stderr


def test_prototype_mode_needs_no_compiled_part(folder):
    code = (
        "import sys; sys.modules['gradysim._netsim'] = None; from gradysim.cli import main; sys.exit(main())"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, "run", "test.ini", "--mode", "prototype"],
        cwd=folder, env=environment(), capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0


# --- Failing protocols ---


@both_modes
def test_a_failing_protocol(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Failing", "--mode", mode)
    assert done.returncode == 1
    lines = done.stderr.splitlines()
    assert lines[0] == "Traceback (most recent call last):"
    assert "protocol.py" in lines[1]
    assert lines[-2] == "RuntimeError: spoilt"
    assert "in handle_packet of node 1 (Failing 1) at 1" in lines[-1]


@both_modes
def test_what_it_computed_until_then_is_shown(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Failing", "--mode", mode)
    assert "interrupted at 1" in done.stdout
    assert "said = 1" in done.stdout


def test_the_runs_after_it_are_not_begun(gradysim):
    done = gradysim("run", "test.ini", "-c", "Failing", "--mode", "prototype", "--json")
    assert [(run["run"], run["interrupted"]) for run in objects(done.stdout)] == [(0, True)]


@both_modes
def test_a_protocol_that_cannot_be_made(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Unmakeable", "--mode", mode)
    assert done.returncode == 1
    assert "RuntimeError: no constructor" in done.stderr
    assert "node 0 (Unmakeable 0)" in done.stderr
    assert done.stdout == ""


# --- Ctrl-C ---


@both_modes
def test_ctrl_c_ends_a_run_cleanly_within_a_second(folder, mode):
    with subprocess.Popen(
        [sys.executable, "-m", "gradysim", "run", "test.ini", "-c", "Endless", "--mode", mode, "--json"],
        cwd=folder,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        while "ready" not in (line := process.stderr.readline()):
            assert line, "it ended before it was ready"
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=1)
    assert process.returncode == 130
    (run,) = objects(out)
    assert run["interrupted"]
    assert 0 < run["sim_time_s"] < 9_000_000
    assert "Traceback" not in err


@both_modes
def test_a_second_ctrl_c_leaves_a_protocol_that_never_returns(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Stuck", "--mode", mode, "--json")
    assert done.returncode == 130
    (run,) = objects(done.stdout)
    assert (run["interrupted"], run["sim_time_s"]) == (True, 1.0)


@both_modes
def test_the_summary_of_an_interrupted_run_says_so(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Stuck", "--mode", mode)
    assert "interrupted at 1 s of simulated time" in done.stdout


# --- Keys ---


def test_keys_are_plain_lines_when_there_is_no_terminal(gradysim):
    done = gradysim("keys", "mobility.speed")
    assert done.returncode == 0
    assert [line.split("\t")[0] for line in done.stdout.splitlines()] == ["*.nodes[*].mobility.speed"]


def test_a_pattern_that_no_key_matches_is_a_mistake(gradysim):
    done = gradysim("keys", "nonsense")
    assert (done.returncode, done.stdout) == (2, "")
    assert "nonsense" in done.stderr
