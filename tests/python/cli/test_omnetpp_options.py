"""`gradysim run --scalars` and `--vectors`: written files, their content, and rejected arguments."""

import json
import sys

import pytest

from gradysim.cli.app import main
from gradysim.results import read_scalars, read_vectors
from gradysim.scenario.resolve.runs import hash_of
from python.cli.command import both_modes, compiled, disk_of, interrupt_endless_run, objects

PROTOTYPE = ("run", "test.ini", "--mode", "prototype")


def names_in(folder):
    return sorted(path.name for path in folder.iterdir())


@both_modes
def test_files_of_each_run(gradysim, folder, mode):
    done = gradysim("run", "test.ini", "--mode", mode, "-r", "0,2", "--scalars", "--vectors", "uavs[1]")
    assert (done.returncode, done.stderr) == (0, "")
    names = [f"General-#{run}.{mode}{suffix}" for run in (0, 2) for suffix in (".sca", ".vec")]
    assert names_in(folder / "results") == names
    assert done.stdout.split()[-1] == "results"


@both_modes
def test_both_are_of_one_run(gradysim, folder, mode):
    arguments = ("-r", "1", "--scalars", "--vectors", "all", "--result-dir", "out", "--quiet")
    gradysim("run", "test.ini", "--mode", mode, *arguments, "--set", "network = field.Field")
    scalars = read_scalars(folder / "out" / f"General-#1.{mode}.sca")
    vectors = read_vectors(folder / "out" / f"General-#1.{mode}.vec")
    assert len({row["runID"] for row in (*scalars, *vectors)}) == 1
    said = [(row["module"], row["value"]) for row in scalars if row["name"] == "said:last"]
    assert said == [("Field.uavs[0].protocol", 10.0), ("Field.uavs[1].protocol", 10.0)]
    counted = {row["module"]: row for row in vectors if row["name"] == "said:vector"}
    assert list(counted) == ["Field.uavs[0].protocol", "Field.uavs[1].protocol"]
    assert list(counted["Field.uavs[1].protocol"]["vecvalue"]) == list(range(11))
    assert list(counted["Field.uavs[1].protocol"]["vectime"])[:3] == [0, 1.01, 2.01]
    assert {(row["runnumber"], row["repetition"], row["mode"]) for row in vectors} == {("1", "1", mode)}


def test_scalars_do_without_vectors_and_vectors_without_scalars(gradysim, folder):
    gradysim(*PROTOTYPE, "-r", "0", "--scalars", "--quiet")
    gradysim(*PROTOTYPE, "-r", "1", "--vectors", "uavs", "--quiet")
    assert names_in(folder / "results") == ["General-#0.prototype.sca", "General-#1.prototype.vec"]


@compiled
def test_outcomes_at_nodes_are_scalars(gradysim, folder):
    gradysim("run", "test.ini", "-r", "0", "--scalars", "--outcomes-at", "uavs[0]", "--quiet")
    rows = read_scalars(folder / "results/General-#0.integrated.sca")
    told = {
        (row["module"], row["name"]): row["value"]
        for row in rows
        if row["module"] in {"Network.uavs[0]", "Network.uavs[0].wlan[0]"}
    }
    assert told == {
        ("Network.uavs[0]", "broadcast:delivered:count"): 10,
        ("Network.uavs[0].wlan[0]", "broadcastMessage:sent:count"): 10,
    }


def values_of(folder, name):
    """Return the values of a scalar in all files of the directory."""
    return [row["value"] for row in read_scalars(folder.glob("*.sca"), [name])]


def test_a_rerun_leaves_no_scalars_and_vectors_of_the_run_before(gradysim, folder):
    arguments = (*PROTOTYPE, "-r", "1", "--result-dir", "out")
    gradysim(*arguments, "--scalars", "--vectors", "uavs")
    done = gradysim(*arguments, "--set", "sim-time-limit=2s", "--replace")
    assert done.returncode == 0
    assert names_in(folder / "out") == ["General-#1.prototype.json"]
    assert [line for line in done.stdout.splitlines() if line.startswith("removed")] == [
        f"removed out/General-#1.prototype.{suffix}, of an earlier run" for suffix in ("sca", "vec")
    ]


def test_a_rerun_with_scalars_leaves_no_vectors_of_the_run_before(gradysim, folder):
    gradysim(*PROTOTYPE, "-r", "1", "--scalars", "--vectors", "uavs")
    gradysim(*PROTOTYPE, "-r", "1", "--scalars", "--set", "sim-time-limit=2s")
    assert names_in(folder / "results") == ["General-#1.prototype.sca"]
    assert values_of(folder / "results", "simTime") == [2]


def test_a_rerun_with_vectors_leaves_no_scalars_of_the_run_before(gradysim, folder):
    gradysim(*PROTOTYPE, "-r", "1", "--scalars", "--vectors", "uavs")
    gradysim(*PROTOTYPE, "-r", "1", "--vectors", "uavs", "--quiet")
    assert names_in(folder / "results") == ["General-#1.prototype.vec"]


def test_files_of_other_runs_stay(gradysim, folder):
    arguments = ("--scalars", "--vectors", "uavs")
    gradysim(*PROTOTYPE, "-r", "1", *arguments)
    gradysim(*PROTOTYPE, "-r", "0", "--scalars")
    assert names_in(folder / "results") == [
        "General-#0.prototype.sca",
        "General-#1.prototype.sca",
        "General-#1.prototype.vec",
    ]


def test_a_run_that_writes_no_files_removes_none(gradysim, folder):
    gradysim(*PROTOTYPE, "-r", "1", "--scalars")
    gradysim(*PROTOTYPE, "-r", "1", "--set", "sim-time-limit=2s")
    assert names_in(folder / "results") == ["General-#1.prototype.sca"]


def test_results_that_resume_goes_by_stay(gradysim, folder):
    gradysim(*PROTOTYPE, "-r", "1", "--result-dir", "results")
    gradysim(*PROTOTYPE, "-r", "1", "--scalars")
    assert names_in(folder / "results") == ["General-#1.prototype.json", "General-#1.prototype.sca"]


def test_runs_that_are_left_out_remove_nothing(gradysim, folder):
    arguments = (*PROTOTYPE, "-r", "1", "--result-dir", "results")
    gradysim(*arguments, "--scalars", "--vectors", "uavs")
    before = names_in(folder / "results")
    gradysim(*arguments, "--resume")
    assert names_in(folder / "results") == before


def test_several_jobs(gradysim, folder):
    done = gradysim(*PROTOTYPE, "-j", "2", "--scalars", "--vectors", "all")
    assert done.returncode == 0
    files = sorted((folder / "results").glob("*.vec"))
    assert {row["runnumber"] for row in read_vectors(files)} == {"0", "1", "2"}
    assert done.stdout.split()[-1] == "results"


def test_json_stays_json(gradysim):
    done = gradysim(*PROTOTYPE, "-r", "0", "--scalars", "--vectors", "all", "--json")
    (run,) = objects(done.stdout)
    assert "vectors" not in run["nodes"][0]
    assert ".sca" in done.stderr
    assert ".vec" in done.stderr


def test_quiet_says_nothing(gradysim):
    done = gradysim(*PROTOTYPE, "-r", "0", "--scalars", "--vectors", "all", "--quiet")
    assert (done.stdout, done.stderr) == ("printed by a protocol\n" * 2, "")


def test_resumed_runs_are_repeated_for_files_that_are_missing(gradysim, folder):
    arguments = (*PROTOTYPE, "--result-dir", "out", "--resume", "--json", "--scalars", "--vectors", "uavs[0]")
    assert len(objects(gradysim(*arguments).stdout)) == 3
    assert len(objects(gradysim(*arguments).stdout)) == 0
    (folder / "out/General-#1.prototype.sca").unlink()
    assert [run["run"] for run in objects(gradysim(*arguments).stdout)] == [1]
    (folder / "out/General-#2.prototype.vec").unlink()
    assert [run["run"] for run in objects(gradysim(*arguments).stdout)] == [2]


def test_resumed_runs_are_repeated_for_nodes_without_vectors(gradysim):
    arguments = (*PROTOTYPE, "--result-dir", "out", "--resume", "--json", "--vectors")
    assert len(objects(gradysim(*arguments, "uavs[0]").stdout)) == 3
    assert len(objects(gradysim(*arguments, "uavs").stdout)) == 3
    assert len(objects(gradysim(*arguments, "uavs[0]").stdout)) == 0


def test_resumed_runs_are_repeated_for_files_of_an_earlier_run(gradysim):
    arguments = (*PROTOTYPE, "--result-dir", "out", "--json", "-r", "0")
    gradysim(*arguments, "--scalars")
    other = ("--set", "sim-time-limit=2s")
    gradysim(*arguments, *other, "--replace")
    assert len(objects(gradysim(*arguments, *other, "--scalars", "--resume").stdout)) == 1


@pytest.fixture
def resumed(gradysim, folder):
    """`resumed(*options)`: numbers of the repeated runs, out of one that left both kinds of files."""
    arguments = (*PROTOTYPE, "--result-dir", "out", "-r", "0", "--json")
    gradysim(*arguments, "--scalars", "--vectors", "uavs")

    def again(*options):
        return [run["run"] for run in objects(gradysim(*arguments, "--resume", *options).stdout)]

    return again


BOTH = ("--scalars", "--vectors", "uavs")


@pytest.mark.parametrize("content", [b"", b"garbage"])
@pytest.mark.parametrize(
    ("suffix", "options"), [("sca", ["--scalars"]), ("vec", ["--vectors", "uavs"]), ("sca", BOTH)]
)
def test_a_resumed_run_is_repeated_for_a_file_that_cannot_be_read(folder, resumed, suffix, options, content):
    (folder / f"out/General-#0.prototype.{suffix}").write_bytes(content)
    assert resumed(*options) == [0]
    assert resumed(*options) == []


@pytest.mark.parametrize("line", ["network = field.Field", "experiment-label = mine"])
@pytest.mark.parametrize("options", [["--scalars"], ["--vectors", "uavs"]])
def test_a_resumed_run_is_repeated_for_files_with_other_labels(resumed, line, options):
    assert resumed(*options) == []
    assert resumed(*options, "--set", line) == [0]
    assert resumed(*options, "--set", line) == []
    assert resumed(*options, "--set", line) == []
    assert resumed("--set", "experiment-label = of no concern to JSON") == []


def test_a_resumed_run_is_repeated_for_newer_files_of_other_settings(gradysim):
    other = ("--set", "sim-time-limit=2s")
    arguments = (*PROTOTYPE, "-r", "0", "--json", "--result-dir", "results")
    gradysim(*arguments)
    gradysim(*PROTOTYPE, "-r", "0", "--scalars", *other, "--replace")
    assert len(objects(gradysim(*arguments, "--scalars", "--resume").stdout)) == 1


@pytest.mark.parametrize("options", [["--vectors", "uavs"], BOTH])
def test_a_resumed_run_is_repeated_for_vectors_of_another_run(gradysim, folder, resumed, options):
    gradysim(*PROTOTYPE, "-r", "0", "--vectors", "uavs")
    (folder / "results/General-#0.prototype.vec").replace(folder / "out/General-#0.prototype.vec")
    assert resumed("--scalars") == []
    assert resumed(*options) == [0]
    assert resumed(*options) == []


def test_a_resumed_run_is_repeated_for_files_of_two_commands_at_once(gradysim, folder, resumed):
    result, vectors = (folder / "out" / f"General-#0.prototype.{suffix}" for suffix in ("json", "vec"))
    gradysim(*PROTOTYPE, "-r", "0", "--vectors", "uavs")
    (folder / "results" / vectors.name).replace(vectors)
    content = json.loads(result.read_text())
    content["output_hashes"][vectors.name] = hash_of(vectors)
    del content["checksum"]
    result.write_text(json.dumps(content))
    assert resumed("--vectors", "uavs") == []
    assert resumed(*BOTH) == [0]


def test_a_resumed_run_is_repeated_for_newer_files_of_another_protocol(gradysim, folder):
    arguments = (*PROTOTYPE, "-r", "0", "--json", "--result-dir", "results")
    gradysim(*arguments)
    protocol = folder / "protocol.py"
    before = protocol.read_text()
    protocol.write_text(before.replace('["said"] += 1', '["said"] += 2'))
    gradysim(*PROTOTYPE, "-r", "0", "--scalars")
    protocol.write_text(before)
    assert len(objects(gradysim(*arguments, "--scalars", "--resume").stdout)) == 1


def test_more_repetitions_leave_what_is_there(resumed):
    assert resumed("--scalars", "--set", "repeat=5") == []


@both_modes
def test_an_interrupted_run_keeps_what_was_computed(folder, mode):
    done = interrupt_endless_run(folder, "--mode", mode, "--scalars", "--vectors", "all", "--quiet")
    assert done.returncode == 130
    rows = read_scalars(folder / f"results/Endless-#0.{mode}.sca")
    assert {row["interrupted"] for row in rows} == {"true"}
    vectors = read_vectors(folder / f"results/Endless-#0.{mode}.vec")
    assert {"said:vector", "positionX:vector"} <= {row["name"] for row in vectors}


@both_modes
def test_a_failing_run_keeps_what_was_computed(gradysim, folder, mode):
    done = gradysim("run", "test.ini", "-c", "Failing", "--mode", mode, "--scalars", "--vectors", "all")
    assert done.returncode == 1
    rows = read_vectors(folder / f"results/Failing-#0.{mode}.vec")
    assert [list(row["vecvalue"]) for row in rows if row["name"] == "said:vector"] == [[0, 1], [0]]


@both_modes
def test_a_run_without_numbers(gradysim, folder, mode):
    (folder / "protocol.py").write_text(
        (folder / "protocol.py")
        .read_text()
        .replace('["said"] = 0', '["said"] = ""')
        .replace("+= 1", '+= "x"')
    )
    gradysim("run", "test.ini", "--mode", mode, "-r", "0", "--scalars", "--vectors", "all", "--quiet")
    scalars = read_scalars(folder / f"results/General-#0.{mode}.sca")
    assert {row["name"] for row in scalars if "uavs" in row["module"]} == {
        f"position{axis}:last" for axis in "XYZ"
    }
    vectors = read_vectors(folder / f"results/General-#0.{mode}.vec")
    assert [(row["name"], len(row["vecvalue"])) for row in vectors] == [
        (f"position{axis}:vector", 0) for axis in "XYZXYZ"
    ]


@both_modes
def test_a_node_that_only_some_runs_have(gradysim, folder, mode):
    arguments = ("run", "test.ini", "--mode", mode, "--quiet", "--vectors", "uavs[2]", "--result-dir", "out")
    study = ("--set", "*.uavs.count=${n=2,4}", "--set", "repeat=1")
    done = gradysim(*arguments, *study)
    assert (done.returncode, done.stderr) == (0, "")
    rows = read_vectors(sorted((folder / "out").glob("*.vec")), "positionX:*")
    assert [(row["n"], row["module"]) for row in rows] == [("4", "Network.uavs[2].mobility")]
    assert "(0..1)" in gradysim(*arguments, *study, "--resume").stderr
    done = gradysim(*arguments, *study, "-r", "0")
    assert done.returncode == 2
    assert done.stderr.startswith("--vectors uavs[2]: ")
    assert " run 0;" in done.stderr


@both_modes
def test_a_wrong_node(gradysim, mode):
    done = gradysim("run", "test.ini", "--mode", mode, "--vectors", "uavs[7]")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("--vectors uavs[7]: ")
    assert "`uavs[" in done.stderr


@pytest.mark.parametrize("option", [("--scalars",), ("--vectors", "all")])
def test_a_folder_that_cannot_be_made(gradysim, folder, option):
    (folder / "results").write_text("")
    done = gradysim(*PROTOTYPE, *option)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("--result-dir results: ")


@pytest.mark.parametrize("option", [["--scalars"], ["--vectors", "all"]])
def test_a_python_without_sqlite(folder, monkeypatch, capsys, option):
    monkeypatch.chdir(folder)
    monkeypatch.setitem(sys.modules, "sqlite3", None)
    assert main([*PROTOTYPE, *option]) == 2
    told = capsys.readouterr().err
    assert told.startswith(f"{' '.join(option)}: ")
    assert told.endswith(" sqlite3\n")
    assert not (folder / "results").exists()


def test_a_file_that_cannot_be_written(gradysim, folder):
    (folder / "out/General-#0.prototype.sca").mkdir(parents=True)
    done = gradysim(*PROTOTYPE, "-r", "0", "--scalars", "--result-dir", "out", "--quiet")
    assert done.returncode == 2
    assert "out/General-#0.prototype.sca" in done.stderr
    assert names_in(folder / "out") == ["General-#0.prototype.sca"]


FLYING = """
from protocol import Talker
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand

class Flying(Talker):
    def initialize(self):
        super().initialize()
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(1000, 0, 0))
"""


@pytest.mark.parametrize(("size", "written"), [(100, []), (20_000, ["json"]), (100_000, ["json", "sca"])])
def test_a_run_without_room_for_its_files_mixes_none_of_the_run_before(gradysim, folder, size, written):
    arguments = (*PROTOTYPE, "-r", "0", "--result-dir", "out", "--quiet", *BOTH)
    (folder / "flying.py").write_text(FLYING, encoding="utf-8")
    flying = ('*.uavs[*].protocol.class="flying.py:Flying"', "*.uavs[*].mobility.telemetryInterval=10ms")
    many_rows = [word for setting in flying for word in ("--set", setting)]
    gradysim(*arguments, *many_rows)
    before = (folder / "out/General-#0.prototype.json").read_text()
    with disk_of(size):
        done = gradysim(*arguments, *many_rows, "--set", "sim-time-limit=9.5s", "--replace")
    assert done.returncode == 2
    suffixes = written or ["json", "sca", "vec"]
    assert names_in(folder / "out") == [f"General-#0.prototype.{suffix}" for suffix in suffixes]
    assert ((folder / "out/General-#0.prototype.json").read_text() == before) is (not written)
    assert set(values_of(folder / "out", "simTime")) <= {9.5 if written else 10.5}
    assert gradysim(*arguments, "--resume", *many_rows).returncode == (2 if written else 0)
