"""`gradysim run --share`: one of several shares of a study."""

import pytest

from gradysim.cli.share import Share, share_of
from gradysim.scenario.errors import ConfigError
from python.cli.command import objects

RUN = ("run", "test.ini", "--mode", "prototype", "--json", "--set", "repeat=7", "--set", "sim-time-limit=1s")

SLURM = {
    "SLURM_ARRAY_TASK_ID": "13",
    "SLURM_ARRAY_TASK_MIN": "10",
    "SLURM_ARRAY_TASK_MAX": "19",
    "SLURM_ARRAY_TASK_STEP": "1",
    "SLURM_ARRAY_TASK_COUNT": "10",
}
SGE = {"SGE_TASK_ID": "7", "SGE_TASK_FIRST": "1", "SGE_TASK_LAST": "10", "SGE_TASK_STEPSIZE": "3"}
OPEN_MPI = {"OMPI_COMM_WORLD_RANK": "1", "OMPI_COMM_WORLD_SIZE": "4"}
MPICH = {"PMI_RANK": "2", "PMI_SIZE": "3"}


def test_each_run_is_in_one_share(gradysim):
    shares = [
        [run["run"] for run in objects(gradysim(*RUN, "--share", f"{index}/3").stdout)] for index in range(3)
    ]
    assert shares == [[0, 3, 6], [1, 4], [2, 5]]


def test_shares_are_dealt_from_the_selected_runs(gradysim):
    done = gradysim(*RUN, "-r", "1,2,4..6", "--share", "1/2")
    assert [run["run"] for run in objects(done.stdout)] == [2, 5]


def test_the_runs_of_a_share_have_the_seeds_of_the_whole_study(gradysim):
    done = gradysim(*RUN, "--seed", "100", "--share", "1/3")
    assert [(run["run"], run["seed"]) for run in objects(done.stdout)] == [(1, 101), (4, 104)]


def test_a_share_may_have_no_run(gradysim):
    done = gradysim(*RUN, "--share", "8/9")
    assert (done.returncode, done.stdout) == (0, "")
    assert done.stderr.startswith("General: --share 8/9 ")


def test_the_command_prints_what_it_read(gradysim, monkeypatch):
    monkeypatch.setenv("JOB_COMPLETION_INDEX", "5")
    done = gradysim(*RUN, "--share", "auto/7")
    assert [run["run"] for run in objects(done.stdout)] == [5]
    assert done.stderr.startswith("--share auto/7: share 5/7, ")


@pytest.mark.parametrize(
    ("given", "environment", "share"),
    [
        ("auto", SLURM, Share(3, 10)),
        ("auto", {**SLURM, "SLURM_ARRAY_TASK_STEP": "3", "SLURM_ARRAY_TASK_COUNT": "4"}, Share(1, 4)),
        ("auto", SGE, Share(2, 4)),
        ("auto", OPEN_MPI, Share(1, 4)),
        ("auto", MPICH, Share(2, 3)),
        ("auto", {**OPEN_MPI, "SGE_TASK_ID": "undefined"}, Share(1, 4)),
        ("auto", {**SLURM, **MPICH}, Share(3 * 3 + 2, 10 * 3)),
        ("auto/4", {"PBS_ARRAY_INDEX": "4"}, Share(0, 4)),
        ("auto/4", {"PBS_ARRAYID": "3"}, Share(3, 4)),
        ("auto/100", SLURM, Share(13, 100)),
        ("auto/5", OPEN_MPI, Share(1, 5)),
        ("auto/100", {**SLURM, **MPICH}, Share(13 * 3 + 2, 100)),
        ("2/3", SLURM, Share(2, 3)),
    ],
)
def test_a_share_follows_from_the_environment(given, environment, share):
    assert share_of(given, environment)[0] == share


@pytest.mark.parametrize(
    ("given", "environment", "part"),
    [
        ("3/3", {}, "0/N to N-1/N"),
        ("auto/0", SLURM, "0/N to N-1/N"),
        ("1", {}, "I/N"),
        ("half", {}, "I/N"),
        ("-1/3", {}, "I/N"),
        ("auto", {}, "SLURM_ARRAY_TASK_ID"),
        ("auto", {"PBS_ARRAY_INDEX": "3"}, "--share auto/N"),
        ("auto", {**SLURM, "SLURM_ARRAY_TASK_COUNT": "2"}, " 2 tasks"),
        ("auto", {**SLURM, "SLURM_ARRAY_TASK_MIN": "x"}, "SLURM_ARRAY_TASK_MIN is `x`"),
        ("auto", {"OMPI_COMM_WORLD_RANK": "3"}, "OMPI_COMM_WORLD_SIZE is ``"),
    ],
)
def test_other_shares_are_errors(given, environment, part):
    with pytest.raises(ConfigError) as error:
        share_of(given, environment)
    assert str(error.value).startswith(f"--share {given}: ")
    assert part in str(error.value)


def test_an_error_ends_the_command(gradysim):
    done = gradysim(*RUN, "--share", "3/3")
    assert (done.returncode, done.stdout) == (2, "")
