"""`gradysim run --result-dir`: a file for each run."""

import json
import os

import pytest

from gradysim.cli.app import main
from python.cli.command import both_modes, compiled


def test_files_of_results_are_written_to_it(gradysim, folder):
    done = gradysim("run", "test.ini", "--mode", "prototype", "-r", "0,2", "--result-dir", "out/here")
    assert sorted(path.name for path in (folder / "out" / "here").iterdir()) == [
        "General-#0.prototype.json",
        "General-#2.prototype.json",
    ]
    assert done.stdout.split()[-1] == "out/here"
    assert json.loads((folder / "out" / "here" / "General-#2.prototype.json").read_text())["run"] == 2


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("test.ini", "it is not a directory"),
        ("dangling", "it is not a directory"),
        ("d" * 300, "File name too long"),
    ],
)
def test_a_folder_that_cannot_be_is_named_with_its_option(folder, gradysim, name, reason):
    (folder / "dangling").symlink_to("nowhere/at/all")
    done = gradysim("run", "test.ini", "--mode", "prototype", "--result-dir", name)
    expected = f"--result-dir {name}: {reason}; expected a directory, or a new name"
    assert (done.returncode, done.stderr.strip()) == (2, expected)


def test_a_folder_that_takes_no_files_is_told_before_the_runs(folder, monkeypatch, capsys):
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    monkeypatch.chdir(folder)
    assert main(["run", "test.ini", "--mode", "prototype", "--quiet", "--result-dir", "out"]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("--result-dir out: ")


@pytest.mark.parametrize(
    ("mode", "option"),
    [("prototype", option) for option in ("--result-dir", "--scalars", "--vectors")]
    + [
        pytest.param("integrated", option, marks=compiled)
        for option in ("--result-dir", "--scalars", "--vectors", "--pcap")
    ],
)
def test_a_configuration_with_too_long_a_name_is_told_before_the_runs(folder, gradysim, mode, option):
    suffixes = {"--result-dir": f".{mode}.json.1234567", "--pcap": "-uavs[1].pcap.1234567"}
    suffix = suffixes.get(option, f".{mode}.sca.1234567")
    fits = 255 - len(f"-#2{suffix}")
    values = {"--result-dir": ["results"], "--scalars": []}.get(option, ["all"])
    for length, code in ((fits + 1, 2), (fits, 0)):
        name = "L" * length
        with (folder / "test.ini").open("a") as file:
            file.write(f"[Config {name}]\n")
        done = gradysim("run", "test.ini", "-c", name, "--mode", mode, "--quiet", option, *values)
        assert done.returncode == code
        if code:
            assert done.stdout == ""
            assert done.stderr.startswith(f"--result-dir results: {name}-#2")


GOES_AWAY = """
import os

class Away(Talker):
    def initialize(self):
        super().initialize()
        os.makedirs("elsewhere", exist_ok=True)
        os.chdir("elsewhere")
"""


@both_modes
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_protocol_that_goes_to_another_folder_takes_no_files_there(folder, gradysim, mode, jobs):
    away = ("--set", '*.uavs[*].protocol.class = "protocol.py:Away"')
    with (folder / "protocol.py").open("a") as protocol:
        protocol.write(GOES_AWAY)
    pcap = ["--pcap", "uavs[0]"] if mode == "integrated" else []
    arguments = ("--scalars", "--vectors", "all", *pcap, "--result-dir", "out", "--quiet", "--jobs", jobs)
    done = gradysim("run", "test.ini", "--mode", mode, *away, *arguments)
    assert (done.returncode, done.stderr) == (0, "")
    assert len(list((folder / "out").iterdir())) == 3 * (3 + len(pcap) // 2)
    assert {path.name for path in folder.rglob("*") if path.is_dir()} - {"__pycache__"} == {
        "out",
        "elsewhere",
    }


def test_a_file_of_a_protocol_that_goes_to_another_folder(folder, gradysim):
    (folder / "elsewhere").mkdir()
    with (folder / "protocol.py").open("a") as protocol:
        protocol.write('import os; os.chdir("elsewhere")')
    done = gradysim("run", "test.ini", "--mode", "prototype", "-r", "0", "--result-dir", "out", "--quiet")
    assert (done.returncode, done.stderr) == (0, "")
    assert [path.name for path in (folder / "out").iterdir()] == ["General-#0.prototype.json"]
