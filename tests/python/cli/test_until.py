"""`gradysim run --until`: repetitions until an interval is narrow enough."""

import json
from pathlib import Path

import pytest

from gradysim.results import read_means
from gradysim.results.confidence_interval import ratio_bounds
from python.cli.command import QUIET

DRAWN = f"""{QUIET}
class Drawn(Quiet):
    spread: float = 0.0
    def initialize(self):
        self.provider.tracked_variables["level"] = 10 + self.spread * self.provider.random.uniform(-1, 1)
        self.provider.tracked_variables["nothing"] = 0.0
        self.provider.tracked_variables["count"] = 0 if self.spread < 1 else 5
        self.provider.tracked_variables["found"] = self.provider.random.random() < 0.7
"""

STUDY = """[General]
sim-time-limit = 1s
repeat = 30
*.uavs.count = 1
*.uavs[*].protocol.class = "drawn.py:Drawn"
*.uavs[*].protocol.spread = ${spread=0.1, 1.2}
"""

LEVEL = "ci(uavs[*] level) < 5%"


@pytest.fixture
def study(gradysim, folder):
    """`study(*arguments, into="out")` runs two values of a variable with at most 30 repetitions of each."""
    (folder / "drawn.py").write_text(DRAWN)
    (folder / "study.ini").write_text(STUDY)

    def run(*arguments, into="out"):
        return gradysim("run", "study.ini", "--mode", "prototype", "--result-dir", into, *arguments)

    return run


def runs_in(directory: Path) -> list[int]:
    return sorted(json.loads(file.read_text())["run"] for file in directory.glob("*.json"))


def test_each_combination_has_as_many_repetitions_as_it_needs(study, folder):
    done = study("--until", LEVEL)
    assert done.returncode == 0
    means = read_means(folder / "out", "uavs[*] level")
    assert means[0].runs == 5
    assert 5 < means[1].runs < 30
    for mean in means:
        assert mean.high - mean.mean < 0.05 * mean.mean
    runs = runs_in(folder / "out")
    assert runs == [*range(5), *range(30, 30 + means[1].runs)]
    assert f"{len(runs)} of 60 " in done.stdout


def test_the_first_repetitions_of_all_values_come_first(study):
    printed = study("--until", LEVEL, "--json").stdout
    assert [json.loads(line)["run"] for line in printed.splitlines()][:5] == [0, 30, 1, 31, 2]


def test_the_runs_do_not_depend_on_the_number_of_jobs(study, folder):
    study("--until", LEVEL)
    alone = runs_in(folder / "out")
    study("--until", LEVEL, "--jobs", "3", into="parallel")
    assert runs_in(folder / "parallel") == alone


def test_resume_goes_on_where_it_was(study, folder):
    study("--until", LEVEL, into="whole")
    study("-r", "0..3,30..32", "--quiet")
    done = study("--until", LEVEL, "--resume", "--json")
    whole = runs_in(folder / "whole")
    assert runs_in(folder / "out") == whole
    assert len(done.stdout.splitlines()) == len(whole) - 7
    again = study("--until", LEVEL, "--resume", "--json")
    assert (again.returncode, again.stdout) == (0, "")


def test_more_repetitions_than_needed_change_nothing(study, folder):
    study("-r", "0..9", "--quiet")
    study("--until", LEVEL, "--resume", "-r", "0..29")
    assert runs_in(folder / "out") == list(range(10))


def test_too_few_repetitions_are_warned_of(study, folder):
    done = study("--until", LEVEL, "--set", "repeat=7", "--quiet")
    assert (done.returncode, done.stdout) == (0, "")
    assert all(part in done.stderr for part in (f" {LEVEL}: ", "% with $spread=1.2; ", "`repeat`"))
    assert len(runs_in(folder / "out")) == 5 + 7


def test_an_event_that_no_run_had_needs_runs_enough_to_be_improbable(study, folder):
    """After 10 runs, an event with a probability of 31 % is still possible; after 15, of 22 %."""
    study("--until", "ci(uavs[*] nothing) < 30%", "-r", "0..29")
    assert runs_in(folder / "out") == list(range(15))


def test_a_count_of_zero_is_complete_if_other_runs_have_more_than_one(study, folder):
    study("--until", "ci(uavs[*] count) < 5%")
    assert runs_in(folder / "out") == [*range(5), *range(30, 35)]


def test_the_interval_of_an_event_decides(study, folder):
    study("--until", "ci(uavs[*] found) < 60%")
    for mean in read_means(folder / "out", "uavs[*] found"):
        bounds = ratio_bounds(round(mean.mean * mean.runs), mean.runs, 0.025)
        assert (mean.low, mean.high) == pytest.approx(bounds)
        assert (mean.high - mean.low) / 2 < 0.6 * mean.mean


def test_a_failing_run_ends_the_study(gradysim):
    arguments = ("--mode", "prototype", "--result-dir", "out", "--until", "ci(uavs[*] said) < 5%")
    done = gradysim("run", "test.ini", "-c", "Failing", *arguments)
    assert done.returncode == 1


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("--until", "level < 5%"), "--until level < 5%: expected `ci(QUANTITY) < 5%`"),
        (("--until", "ci(uavs[*] level) < 0%"), "expected `ci(QUANTITY) < 5%`"),
        (("--until", "ci(uavs[*] levle) < 5%"), "did you mean `uavs[*] level`?"),
        (("--until", LEVEL, "--set", "repeat=1"), "a single repetition has no interval; expected `repeat`"),
    ],
)
def test_mistakes(study, arguments, told):
    done = study(*arguments, "--quiet")
    assert (done.returncode, done.stdout) == (2, "")
    assert told in done.stderr


def test_it_needs_a_directory(gradysim):
    done = gradysim("run", "test.ini", "--until", "ci(uavs[*] said) < 5%")
    assert done.returncode == 2
    assert done.stderr.startswith("--until: ")
