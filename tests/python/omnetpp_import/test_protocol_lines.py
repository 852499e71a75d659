"""What becomes of lines about protocols, applications and missions."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.omnetpp_import import Action, Outcome
from gradysim.omnetpp_import.tables import DRAWN, OTHER_APP

FirstOutcome = Callable[..., Outcome]

DADCA = '*.quads[0..2].protocol.typename = "DadcaProtocol"'
SOURCE = '*.quads[*].app[0].typename = "UdpBasicApp"'


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (DADCA, '*.quads[0..2].protocol.class = "gradysim.showcases:DadcaProtocol"'),
        (
            "*.quads[*].protocol.timeoutDuration = ${3s, 5s}",
            "*.quads[*].protocol.timeout_duration = ${3s, 5s}",
        ),
        ("*.quads[*].app[0].sendInterval = 2s", "*.quads[*].protocol.send_interval = 2s"),
        ("*.quads[1].app[*].startTime = normal(1s, 1s)", "*.quads[1].protocol.start_time = normal(1s, 1s)"),
        ("**.app[0].stopTime = -1s", "**.protocol.stop_time = -1s"),
        ("*.quads[0].mobility.startTime = 40s", "*.quads[0].protocol.takeoff_time = 40s"),
        ("*.quads[*].mobility.waypointProximity = 2m", "*.quads[*].protocol.tolerance = 2m"),
    ],
)
def test_of_a_protocol_of_the_showcases(outcome: FirstOutcome, before: str, after: str) -> None:
    found = outcome(before, DADCA)
    assert (found.action, found.text) == (Action.RENAMED, after)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (SOURCE, '*.quads[*].protocol.class = "gradysim.showcases:UdpBasicApp"'),
        ('*.quads[*].app[0].typename = "UdpSink"', '*.quads[*].protocol.typename = "SinkProtocol"'),
        ("*.quads[*].app[*].messageLength = 100Byte", "*.quads[*].protocol.message_length = 100Byte"),
    ],
)
def test_of_an_application(outcome: FirstOutcome, before: str, after: str) -> None:
    found = outcome(before, SOURCE)
    assert (found.action, found.text) == (Action.RENAMED, after)


@pytest.mark.parametrize(
    ("line", "action", "note"),
    [
        ('*.quads[0].app[1].typename = "UdpSink"', Action.NOT_MODELLED, OTHER_APP),
        ("*.quads[*].app[0].sendInterval = exponential(1s)", Action.NOT_MODELLED, DRAWN),
        ("*.quads[*].protocol.colour = 3", Action.NOT_MODELLED, "there is no such parameter"),
        ("*.quads[*].app[0].startTime = 1s*index", Action.TO_WRITE, "1s*index: "),
        ("*.quads[*].app[0].localPort = 1000", Action.LEFT_OUT, ""),
    ],
)
def test_of_what_there_is_no_counterpart(outcome: FirstOutcome, line: str, action: Action, note: str) -> None:
    found = outcome(line, DADCA)
    assert found.action is action
    assert note in found.note


@pytest.mark.parametrize(
    ("line", "text", "note"),
    [
        ('*.quads[0].protocol.typename = "Own"', '*.quads[0].protocol.class = "FILE.py:CLASS"', "Own"),
        ("*.quads[*].protocol.timeoutDuration = 3s", "*.quads[*].protocol.timeoutDuration = 3s", "attribute"),
        ('*.quads[*].mobility.waypointFile = "a.waypoints"', "", "fly-a-mission"),
    ],
)
def test_of_a_protocol_that_only_the_user_knows(
    outcome: FirstOutcome, line: str, text: str, note: str
) -> None:
    found = outcome(line, '*.quads[*].protocol.typename = "Own"')
    assert (found.action, found.text) == (Action.TO_WRITE, text)
    assert note in found.note


def test_a_mission_becomes_positions(outcome: FirstOutcome, tmp_path: Path) -> None:
    (tmp_path / "a.waypoints").write_text("QGC WPL 110\n0 0 3 16 0 0 0 0 -15.841 -47.92 20 1\n")
    line = '*.quads[*].mobility.waypointFile = ${path="a.waypoints", "missing"}'
    assert outcome(line, DADCA).action is Action.TO_WRITE
    scene = ["*.coordinateSystem.sceneLatitude = -15.84deg", "*.coordinateSystem.sceneLongitude = -47.92deg"]
    geographic = '*.quads[*].mobility.coordinateSystemModule = "coordinateSystem"'
    found = outcome(line.replace(', "missing"', ""), DADCA, geographic, *scene)
    case = '${path="a.waypoints"} == "a.waypoints" ? "-111.19 0 20" : ""'
    assert found.text == f"*.quads[*].protocol.mission = {case}"


def test_missions_of_a_study_keep_the_names_of_their_files(outcome: FirstOutcome, tmp_path: Path) -> None:
    for name in "ab":
        (tmp_path / name).write_text(f"QGC WPL 110\n0 0 3 16 0 0 0 0 {ord(name)} 0 20 1\n")
    found = outcome('*.quads[*].mobility.waypointFile = ${path="a", "b"}', DADCA)
    cases = '${path="a", "b"} == "a" ? "97 0 20" : ${path} == "b" ? "98 0 20" : ""'
    assert (found.action, found.text) == (Action.RENAMED, f"*.quads[*].protocol.mission = {cases}")


def test_a_mission_without_a_scene(outcome: FirstOutcome, tmp_path: Path) -> None:
    (tmp_path / "a.waypoints").write_text("QGC WPL 110\n0 0 3 16 0 0 0 0 -15.84 -47.92 20 1\n")
    assert outcome('*.quads[*].mobility.waypointFile = "a.waypoints"', DADCA).text.endswith(
        '"-15.84 -47.92 20"'
    )


@pytest.mark.parametrize("name", ["protocolMobile", "protocolSensor", "protocolGround"])
def test_a_protocol_in_python(outcome: FirstOutcome, name: str) -> None:
    found = outcome(
        f'*.quads[*].protocol.{name} = "Mobile"',
        '*.quads[*].protocol.customProtocolLocation = "./"',
        '*.quads[*].protocol.protocol = "zigzag"',
        '*.quads[*].protocol.protocolFileName = "protocol_mobile"',
    )
    assert found.text == '*.quads[*].protocol.class = "../zigzag/protocol_mobile.py:Mobile"'


def test_a_protocol_in_python_without_a_directory(outcome: FirstOutcome) -> None:
    file = '*.quads[*].protocol.protocolFileName = "survey.py"'
    found = outcome('*.quads[*].protocol.protocol = "Collector"', file)
    assert found.text == '*.quads[*].protocol.class = "../survey.py:Collector"'
    assert outcome(file, '*.quads[*].protocol.protocol = "Collector"').action is Action.LEFT_OUT
