"""`gradysim run --outcomes-at`: reports of single nodes, and rejected arguments."""

from python.cli.command import compiled, objects


@compiled
def test_results_tell_of_the_nodes_that_are_named(gradysim):
    done = gradysim("run", "test.ini", "-r", "0", "--json", "--outcomes-at", "uavs[1]")
    ((first, second),) = (run["nodes"] for run in objects(done.stdout))
    assert "frame_outcomes" not in first
    assert second["frame_outcomes"] == {"broadcast": {"delivered": 10}}
    assert second["interferers"] == {}
    assert second["message_outcomes"] == {"wlan[0]": {"broadcast": {"sent": 10}}}


@compiled
def test_the_former_name_of_the_option(gradysim):
    results = [
        objects(gradysim("run", "test.ini", "-r", "0", "--json", option, "uavs[1]").stdout)
        for option in ("--fates-at", "--outcomes-at")
    ]
    assert [run["nodes"][1]["frame_outcomes"] for (run,) in results] == [{"broadcast": {"delivered": 10}}] * 2


@compiled
def test_the_summary_tells_of_them(gradysim):
    done = gradysim("run", "test.ini", "-r", "0", "--outcomes-at", "all")
    lines = [line.split() for line in done.stdout.splitlines()]
    assert ["uavs[0]", "broadcast", "10"] in lines
    assert ["uavs[1]", "broadcast", "10"] in lines


@compiled
def test_messages_of_one_group_are_told_apart_from_those_of_another(gradysim):
    sensors = ["*.sensors.count=1", '*.sensors[*].protocol.typename="SaturatingSource"']
    overrides = [word for line in sensors for word in ("--set", line)]
    done = gradysim("run", "test.ini", "-r", "0", "--json", "--outcomes-at", "all", *overrides)
    (run,) = objects(done.stdout)
    kinds = {node["name"]: node["message_outcomes"]["wlan[0]"].keys() for node in run["nodes"]}
    assert kinds == {"uavs[0]": {"broadcast"}, "uavs[1]": {"broadcast"}, "sensors[0]": {"unicast"}}


@compiled
def test_resumed_runs_are_repeated_for_nodes_that_were_not_told_of(gradysim):
    arguments = ("run", "test.ini", "--result-dir", "out", "--resume", "--json", "--outcomes-at")
    assert len(objects(gradysim(*arguments, "uavs[0]").stdout)) == 3
    assert len(objects(gradysim(*arguments, "uavs[0]").stdout)) == 0
    assert len(objects(gradysim(*arguments, "uavs").stdout)) == 3


@compiled
def test_a_node_that_only_some_runs_have(gradysim, folder):
    study = ("--set", "*.uavs.count=${2,3}", "--set", "repeat=1")
    done = gradysim("run", "test.ini", "--json", *study, "--outcomes-at", "uavs[2]", "--pcap", "uavs[2]")
    told = [
        [node["name"] for node in run["nodes"] if "frame_outcomes" in node] for run in objects(done.stdout)
    ]
    assert told == [[], ["uavs[2]"]]
    assert [file.name for file in folder.glob("results/*.pcap")] == ["General-#1-uavs[2].pcap"]


@compiled
def test_a_wrong_node(gradysim):
    done = gradysim("run", "test.ini", "--outcomes-at", "uavs[7]")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("--outcomes-at uavs[7]: ")


def test_prototype_mode_has_no_frames(gradysim):
    done = gradysim("run", "test.ini", "--mode", "prototype", "--outcomes-at", "all")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("--outcomes-at all: ")
    assert "--mode integrated" in done.stderr
