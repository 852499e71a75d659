"""`gradysim compare`: from the files of `run --result-dir`."""

import csv
import json

import pytest

TWO_STUDIES = (
    (("--mode", "prototype", "--result-dir", "before", "--quiet"), "3.5s"),
    (("--mode", "prototype", "--result-dir", "after", "--quiet"), "5.5s"),
)


@pytest.fixture
def studies(gradysim):
    """Write three runs that end at 3.5 s to `before`, and two of them that end at 5.5 s to `after`."""
    for (options, limit), wanted in zip(TWO_STUDIES, ("0..2", "1,2"), strict=True):
        gradysim("run", "test.ini", "-r", wanted, "--set", f"sim-time-limit={limit}", *options)


def rows(text):
    return list(csv.DictReader(text.splitlines()))


def test_two_directories(gradysim, studies):
    done = gradysim("compare", "before", "after")
    assert done.returncode == 0
    assert done.stderr.split()[0] == "before:"
    assert "1" in done.stderr.split()
    title, headings, _, *lines = [line.split() for line in done.stdout.splitlines()]
    assert title == ["General,", "prototype", "mode"]
    assert headings[:4] == ["quantity", "before", "after", "difference"]
    assert ["uavs[*]", "said", "3", "5", "+2", "0", "*", "2"] in lines
    assert done.stdout.splitlines()[-1].startswith("* ")


def test_losses_by_cause(gradysim, studies):
    lossy = ("--set", "*.communicationMedium.failureRate=0.5", "--result-dir", "lossy", "--quiet")
    gradysim("run", "test.ini", "--mode", "prototype", *lossy)
    printed = gradysim("compare", "before", "lossy", "--metric", "uavs[*] said").stdout
    assert "losses" in printed
    assert "\nbroadcast " in printed


def test_numbers_for_other_programs(gradysim, studies):
    done = gradysim("compare", "before", "after", "--metric", "uavs[*] said", "--csv")
    said = rows(done.stdout)[0]
    assert said["quantity"] == "uavs[*] said"
    assert (said["pairs"], said["first"], said["second"]) == ("2", "3.0", "5.0")
    assert (said["difference"], said["difference_low"], said["difference_high"]) == ("2.0", "2.0", "2.0")
    assert (said["config"], said["mode"]) == ("General", "prototype")


RANGE = ("--set", "*.*.wlan[*].radio.transmitter.communicationRange=60m")


@pytest.mark.parametrize(("settings", "warnings"), [(RANGE, 0), ((), 1)])
def test_two_modes_of_one_directory(gradysim, settings, warnings):
    for mode in ("integrated", "prototype"):
        gradysim("run", "test.ini", "--mode", mode, "--result-dir", "out", "--quiet", *settings)
    done = gradysim("compare", "out", "--by", "mode", "--baseline", "prototype")
    assert done.returncode == 0
    assert done.stderr.count("warning: in run 0 ") == warnings
    assert done.stdout.splitlines()[1].split()[:3] == ["quantity", "prototype", "integrated"]


def test_a_figure(gradysim, studies, folder):
    pytest.importorskip("matplotlib")
    done = gradysim("compare", "before", "after", "-o", "change.svg", "--metric", "uavs[*] said")
    assert "change.svg" in done.stdout
    (row,) = rows((folder / "change.csv").read_text())
    assert (row["quantity"], float(row["percent"])) == ("uavs[*] said", pytest.approx(200 / 3))
    origin = json.loads((folder / "change.json").read_text())
    assert origin["compared"] == ["before", "after"]
    assert len(origin["runs"]) == 4


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("before",), "there is nothing to compare; expected a second directory, or --by VARIABLE"),
        (("before", "nowhere"), "nowhere: there is no such directory"),
        (("before", "after", "--by", "mode"), "--by mode: there are two directories to compare"),
        (("before", "after", "--baseline", "x"), "--baseline x: expected --by VARIABLE, too"),
        (("before", "after", "--where", "mode"), "--where mode: expected VARIABLE=VALUE"),
        (("before", "--by", "mode"), "--by mode: the runs have 1 value of it (prototype); expected two"),
        (("before", "--by", "mod"), "did you mean `mode`?"),
        (("before", "--by", "seed", "--where", "seed=0", "seed=1"), "no two runs to compare"),
        (("before", "after", "--metric", "uavs said"), "did you mean `uavs[*] said`?"),
        (("before", "after", "-o", "change.txt"), "change.txt: `.txt` is not a format"),
    ],
)
def test_mistakes(gradysim, studies, arguments, told):
    done = gradysim("compare", *arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert told in done.stderr


def test_a_baseline_that_no_run_has(gradysim, studies):
    arguments = ("--by", "seed", "--where", "seed=0", "seed=1", "--baseline", "2")
    done = gradysim("compare", "before", *arguments)
    assert done.stderr.startswith("--baseline 2: ")
    assert done.stderr.endswith(" 0, 1\n")
