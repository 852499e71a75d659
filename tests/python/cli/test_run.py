"""`gradysim run` as a user sees it: a process with arguments, output and an exit code."""

import contextlib
import io
import subprocess
import sys

import pytest

from gradysim.cli.app import main
from gradysim.results.quantity import quantities
from gradysim.results.result import RunResult
from python.cli.command import PROTOCOL, both_modes, compiled, environment, objects


@both_modes
def test_the_summary(gradysim, mode):
    done = gradysim("run", "test.ini", "--mode", mode, "-r", "1")
    assert done.returncode == 0, done.stderr
    for text in ("General run 1", "seed 1", f"{mode} mode", "uavs[1]", "said", "10", "delivered", "10.5 s"):
        assert text in done.stdout
    assert done.stderr == ""


@both_modes
def test_several_runs_are_a_line_each(gradysim, mode):
    done = gradysim("run", "test.ini", "--mode", mode)
    lines = [line for line in done.stdout.splitlines() if line != "printed by a protocol"]
    assert [line.split("  ")[:3] for line in lines] == [
        [f"General run {number}", f"#{number}", "said 10"] for number in range(3)
    ]


@both_modes
def test_details_are_tables_of_each_run(gradysim, mode):
    done = gradysim("run", "test.ini", "--mode", mode, "--details", "--result-dir", "out")
    assert done.stdout.count("\nprocessor time") == 3
    assert done.stdout.count(f"out/General-#2.{mode}.json") == 1


@compiled
def test_integrated_is_the_default(gradysim):
    assert "integrated" in gradysim("run", "test.ini", "-r", "0").stdout


def test_all_runs_are_the_default(gradysim):
    done = gradysim("run", "test.ini", "--mode", "prototype", "--json")
    assert [run["run"] for run in objects(done.stdout)] == [0, 1, 2]


def test_chosen_runs(gradysim):
    done = gradysim("run", "test.ini", "--mode", "prototype", "--json", "-r", "0,2")
    assert [run["run"] for run in objects(done.stdout)] == [0, 2]


@both_modes
def test_the_json_is_the_whole_result(gradysim, mode):
    (run,) = objects(gradysim("run", "test.ini", "--mode", mode, "--json", "-r", "0").stdout)
    assert list(run) == [name for name, quantity in quantities(RunResult).items() if quantity.in_json]
    assert set(run["nodes"][0]) == {"id", "name", "protocol", "position", "tracked_variables"}
    assert run["mode"] == mode
    assert run["nodes"][0]["tracked_variables"] == {"said": 10}


@pytest.mark.parametrize("origin", ["protocol", "module"])
def test_what_protocols_print_is_kept_out_of_the_json(gradysim, origin):
    done = gradysim("run", "test.ini", "-c", "Chatty", "--mode", "prototype", "--json", "-r", "0")
    assert len(done.stdout.splitlines()) == 1
    assert f"by a {origin}" in done.stderr


def test_a_file_may_come_out_of_a_pipe(folder):
    text = (folder / "test.ini").read_text().replace('.class = "', f'.class = "{folder}/')
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "gradysim",
            "run",
            "/dev/stdin",
            "-c",
            "Chatty",
            "-r",
            "0",
            "--mode",
            "prototype",
        ],
        env=environment(),
        input=text,
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert (done.returncode, done.stderr) == (0, "")


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
    assert ("seed 4" in done.stderr) is warned


def test_two_runs_of_one_seed_are_warned_of(gradysim):
    arguments = ("-r", "0,1", "--mode", "prototype", "--quiet", "--set", "seed-set=4")
    assert "seed 4" in gradysim("run", "test.ini", *arguments).stderr


@both_modes
@pytest.mark.parametrize("seed", [-1, 2**63, 2**64 - 1, 2**64])
def test_a_seed_out_of_range_is_refused(gradysim, mode, seed):
    done = gradysim("run", "test.ini", "--mode", mode, f"--seed={seed}")
    expected = f"--seed {seed}: it is out of range; expected 0 to {2**63 - 1}"
    assert (done.returncode, done.stdout, done.stderr.strip()) == (2, "", expected)


@both_modes
def test_a_seed_that_leaves_no_room_for_the_last_run_is_refused(gradysim, mode):
    largest = 2**63 - 1
    done = gradysim("run", "test.ini", "--mode", mode, f"--seed={largest - 1}")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"--seed {largest - 1}: run 2 ")
    assert f" {largest - 2}, " in done.stderr


@both_modes
def test_the_largest_seed_runs(gradysim, mode):
    done = gradysim("run", "test.ini", "--mode", mode, f"--seed={2**63 - 1}", "-r", "0", "--json")
    assert [run["seed"] for run in objects(done.stdout)] == [2**63 - 1]


@both_modes
def test_the_same_seed_gives_the_same_result_hash_in_another_process(gradysim, mode):
    command = ("run", "test.ini", "--mode", mode, "--json", "-r", "0")
    first, again = (objects(gradysim(*command).stdout)[0]["result_hash"] for _ in range(2))
    assert first == again


def test_runs_of_different_values_may_have_one_seed(gradysim):
    varied = ("--set", "sim-time-limit=${limit=1, 2, 3}s", "--set", "repeat=1", "--set", "seed-set=4")
    done = gradysim("run", "test.ini", "--mode", "prototype", "--json", *varied)
    assert "warning" not in done.stderr
    assert [(run["iterations"], run["sim_time_s"]) for run in objects(done.stdout)] == [
        ({"limit": 1}, 1.0),
        ({"limit": 2}, 2.0),
        ({"limit": 3}, 3.0),
    ]


def test_runs_lists_the_values_of_iteration_variables(gradysim):
    done = gradysim("runs", "test.ini", "--set", "repeat=2", "--set", "sim-time-limit=${limit=1s, 2s}")
    assert done.stdout.splitlines() == [
        "Run 0: $limit=1s, $repetition=0",
        "Run 1: $limit=1s, $repetition=1",
        "Run 2: $limit=2s, $repetition=0",
        "Run 3: $limit=2s, $repetition=1",
    ]


def test_runs_lists_those_of_an_abstract_configuration(gradysim, folder):
    with (folder / "test.ini").open("a") as file:
        file.write("[Base]\nabstract = true\nrepeat = 2\n")
    done = gradysim("runs", "test.ini", "-c", "Base")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines() == ["Run 0: $repetition=0", "Run 1: $repetition=1"]
    assert gradysim("run", "test.ini", "-c", "Base").returncode == 2


def test_runs_lists_the_runs(gradysim):
    done = gradysim("runs", "test.ini", "-c", "Failing")
    assert done.returncode == 0
    assert done.stdout.splitlines() == [
        "Run 0: $repetition=0",
        "Run 1: $repetition=1",
        "Run 2: $repetition=2",
    ]


def in_ascii(folder, *arguments):
    """Return the output of the command if the stream takes ASCII only."""
    return subprocess.run(
        [sys.executable, "-m", "gradysim", *arguments],
        cwd=folder,
        env={**environment(), "PYTHONIOENCODING": "ascii"},
        capture_output=True,
        text=True,
        check=False,
    )


def test_an_output_that_takes_ascii_only_loses_no_result(folder):
    accents = PROTOCOL.replace(
        'tracked_variables["said"] = 0', 'tracked_variables.update(said=0, olá="maçã")'
    )
    (folder / "protocol.py").write_text(accents, encoding="utf-8")
    done = in_ascii(folder, "run", "test.ini", "--mode", "prototype", "-r", "0", "--result-dir", "out")
    assert (done.returncode, done.stderr) == (0, "")
    assert "ol\\xe1" in done.stdout
    assert "ma\\xe7\\xe3" in done.stdout
    assert [path.name for path in (folder / "out").iterdir()] == ["General-#0.prototype.json"]


@compiled
def test_reception_over_distance_is_drawn_in_ascii_if_that_is_all_there_is(folder):
    done = in_ascii(folder, "calibrate", "test.ini", "--range", "50m")
    assert (done.returncode, done.stderr) == (0, "")
    assert "100.00 %  " + 40 * "#" in done.stdout


@compiled
def test_calibrate_says_which_run_of_a_study_it_is_about(gradysim):
    study = ("--set", "**.wlan[*].bitrate=${rate=6, 54}Mbps")
    done = gradysim("calibrate", "test.ini", "--range", "50m", *study)
    assert "run 0, $rate=6" in done.stdout


@compiled
def test_calibrate_is_told_who_sends_what_to_whom(gradysim):
    base = ("--set", '*.base.protocol.class="protocol.py:Quiet"')
    options = ("--sender", "base", "--receiver", "uavs[1]", "--message", "700B", "--ratio", "0.9")
    first, second, *_ = gradysim(
        "calibrate", "test.ini", "--range", "50m", *base, *options
    ).stdout.splitlines()
    assert "base to uavs[1]:" in first
    assert "(700 B " in second


@compiled
def test_calibrate_draws_the_picture_that_was_asked_for(gradysim, folder):
    pytest.importorskip("matplotlib")
    done = gradysim("calibrate", "test.ini", "--range", "50m", "--picture", "curve.svg")
    assert (done.returncode, done.stderr) == (0, "")
    assert "curve.svg" in done.stdout
    assert (folder / "curve.svg").is_file()


@compiled
def test_the_command_can_be_called_from_python(folder):
    output = io.StringIO()  # without an encoding
    with contextlib.redirect_stdout(output):
        assert main(["calibrate", str(folder / "test.ini"), "--range", "50m"]) == 0
    assert 40 * "█" in output.getvalue()


def test_runs_lists_the_runs_of_a_configuration_without_nodes_or_time_limit(gradysim, folder):
    (folder / "bare.ini").write_text("[General]\nrepeat = 2\n*.uavs[*].speed = ${speed=1, 2}mps\n")
    done = gradysim("runs", "bare.ini")
    assert (done.returncode, len(done.stdout.splitlines())) == (0, 4)
