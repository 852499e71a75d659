"""`gradysim run` with random values."""

import json

import pytest

from python.cli.command import both_modes, compiled

SCATTERED = ("--set", "*.uavs[*].mobility.initialX = uniform(0m, 1km)")


def positions(done):
    assert done.returncode == 0, done.stderr
    return [[node["position"] for node in json.loads(line)["nodes"]] for line in done.stdout.splitlines()]


@compiled
def test_both_modes_have_the_same_places(gradysim):
    integrated, prototype = (
        positions(gradysim("run", "test.ini", "--json", *SCATTERED, "--mode", mode))
        for mode in ("integrated", "prototype")
    )
    assert integrated == prototype
    assert len({x for run in integrated for x, _, _ in run}) == 6


@both_modes
def test_the_seed_of_the_command_line_draws_them(gradysim, mode):
    command = ("run", "test.ini", "--json", *SCATTERED, "--mode", mode)
    of_all_runs = positions(gradysim(*command))
    assert positions(gradysim(*command, "-r", "1", "--seed", "0")) == of_all_runs[1:2]
    assert positions(gradysim(*command, "-r", "0", "--seed", "2")) == of_all_runs[2:]


def test_runs_that_draw_can_be_resumed_and_have_means(gradysim):
    command = ("run", "test.ini", "--quiet", *SCATTERED, "--mode", "prototype", "--result-dir", "out")
    gradysim(*command, "-r", "0,2")
    assert "(0,2)" in gradysim(*command, "--resume").stderr
    done = gradysim("means", "out")
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize(
    ("value", "problem", "hint"),
    [
        ("unifrom(0m, 1m)", "`unifrom`", "`uniform`?"),
        (
            "uniform(0m, 1s)",
            "for uavs[0].mobility.initialX with seed 0: `uniform`: `0m` and `1s`",
            "",
        ),
        (
            "intuniform(5, 5) * 1e9m",
            "5000000000.0m for uavs[0].mobility.initialX with seed 0: ",
            "",
        ),
    ],
)
def test_a_mistake_is_told_with_its_place(gradysim, folder, value, problem, hint):
    with (folder / "test.ini").open("a") as file:
        file.write(f"\n[Config Scattered]\n*.uavs[*].mobility.initialX = {value}\n")
    line = len((folder / "test.ini").read_text().splitlines())
    done = gradysim("run", "test.ini", "-c", "Scattered")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"test.ini:{line}: *.uavs[*].mobility.initialX = {value}: ")
    assert problem in done.stderr
    assert done.stderr.endswith(f"{hint}\n")
