from typing import Any

import pytest

from gradysim.scenario import load_scenarios
from gradysim.scenario.errors import ConfigError

NODES = "expected one of `groundStation`, `uavs[*]`"


@pytest.mark.parametrize(
    ("key", "message"),
    [
        (
            "*.uavz[*].mobility.speed",
            f"`*.uavz[*].mobility.speed` matches no node; {NODES}; did you mean `*.uavs[*].mobility.speed`?",
        ),
        (
            "*.uavz[*].mobility.sped",
            f"`*.uavz[*].mobility.sped` matches no node; {NODES}; did you mean `*.uavs[*].mobility.sped`?",
        ),
        (
            "*.physicalEnvironment.config",
            f"`*.physicalEnvironment.config` matches no node; {NODES}; "
            "obstacles are below `environment` here: `gradysim keys environment`",
        ),
        (
            "*.uavs[*].app[0].typename",
            "`*.uavs[*].app[0].typename` matches no parameter; expected the name of one; "
            "the messages of a node are those of its protocol here, `protocol.class`",
        ),
        (
            "**.ipv4.arp.typename",
            "`**.ipv4.arp.typename` matches no parameter; expected the name of one; "
            "nodes are addressed by their ids here, and this line can go",
        ),
        (
            "*.radioMedum.pathLoss.alpha",
            f"`*.radioMedum.pathLoss.alpha` matches no node; {NODES}; "
            "did you mean `*.radioMedium.pathLoss.alpha`?",
        ),
        (
            "*.boats[*].mobility.speed",
            "`*.boats[*].mobility.speed` matches no node: nothing says how many `boats` there are; "
            "expected `*.numBoats = ...`",
        ),
        (
            "*.uavs[7].mobility.speed",
            "`*.uavs[7].mobility.speed` matches no node; "
            "expected `uavs` as it is, with nodes uavs[0] to uavs[1]; "
            "did you mean `*.uavs[*].mobility.speed`?",
        ),
        (
            "*.groundStation[*].mobility.speed",
            "`*.groundStation[*].mobility.speed` matches no node; "
            "expected `groundStation` as it is, with one node, without index; "
            "did you mean `*.groundStation.mobility.speed`?",
        ),
        (
            "*.numuavs",
            "`*.numuavs` matches no node; "
            "expected a capital letter where the group's name begins: `*.numUavs`",
        ),
        (
            "*.numberOfUavs",
            "`*.numberOfUavs` matches no node; expected one of `groundStation`, `uavs[*]`; "
            "did you mean `*.numUavs`?",
        ),
        (
            "*.uavs.mobility.speed",
            "`*.uavs.mobility.speed` matches no parameter; expected the name of one; "
            "did you mean `*.uavs[*].mobility.speed`?",
        ),
        (
            "**.wlan[0].mac.rtsThreshold",
            "`**.wlan[0].mac.rtsThreshold` matches no parameter; expected the name of one; "
            "did you mean `**.wlan[0].mac.dcf.rtsPolicy.rtsThreshold`?",
        ),
        (
            "*.uavs[1].power",
            "`*.uavs[1].power` matches no parameter; expected the name of one; "
            "did you mean `*.uavs[1].wlan[*].radio.transmitter.power`?",
        ),
        (
            "*.radioMedium.sigma",
            "`*.radioMedium.sigma` matches no parameter; expected the name of one; "
            "did you mean `*.radioMedium.pathLoss.sigma`?",
        ),
        (
            "uavs[*].mobility.speed",
            "`uavs[*].mobility.speed` does not begin with `*.` or `**.`, "
            "nor with the network's name `Network.`; "
            "expected a key such as `*.uavs[*].mobility.speed`; did you mean `*.uavs[*].mobility.speed`?",
        ),
        (
            "*.uavs[0].wlan[0].radio.transmiter.power",
            "`*.uavs[0].wlan[0].radio.transmiter.power` matches no parameter; expected the name of one; "
            "did you mean `*.uavs[0].wlan[0].radio.transmitter.power`?",
        ),
        (
            "*.uavs[*].bitrate",
            "`*.uavs[*].bitrate` matches no parameter; expected the name of one; "
            "did you mean `*.uavs[*].wlan[*].bitrate`?",
        ),
        (
            "*.radioMedium.pathLoss.alfa",
            "`*.radioMedium.pathLoss.alfa` matches no parameter; expected the name of one; "
            "did you mean `*.radioMedium.pathLoss.alpha`?",
        ),
        (
            "**.powr",
            "`**.powr` matches no parameter; expected the name of one; did you mean `**.power`?",
        ),
        ("n[1..2]", "`n[1..2]` matches no parameter; expected the name of one"),
        ("*.", "`*.` matches no node; expected one of `groundStation`, `uavs[*]`"),
        ("*..uavs", f"`*..uavs` matches no node; {NODES}; did you mean `*.numUavs`?"),
        (
            "**.radio.transmiter.power",
            "`**.radio.transmiter.power` matches no parameter; expected the name of one; "
            "did you mean `**.radio.transmitter.power`?",
        ),
        (
            "**.heartbeat_jiter",
            "`**.heartbeat_jiter` matches no parameter; expected the name of one; "
            "did you mean `**.heartbeat_jitter`?",
        ),
        (
            "*.uavs[*].protocol.heartbeat_jiter",
            "`heartbeat_jiter` is no parameter of Mobile; "
            "expected one of class, eager, heartbeat_jitter, label, launch_interval, retries, typename; "
            "did you mean `*.uavs[*].protocol.heartbeat_jitter`?",
        ),
        (
            "*.uavs[*].protocol.waypoints",
            "`waypoints` is no parameter of Mobile, it is of type list and not a plain public value; "
            "expected one of class, eager, heartbeat_jitter, label, launch_interval, retries, typename",
        ),
        (
            "*.groundStation.protocol.label",
            "`label` is no parameter of Sensor; expected one of class, typename",
        ),
        (
            "*.*.protocol.lable",
            "`lable` is no parameter of Mobile or Sensor; "
            "expected one of class, eager, heartbeat_jitter, label, launch_interval, retries, typename; "
            "did you mean `*.*.protocol.label`?",
        ),
    ],
)
def test_says_what_was_expected_and_the_nearest_key(folder: Any, key: str, message: str) -> None:
    assert folder.error(f"{key} = 1\n") == f"test.ini:6: {message}"


@pytest.mark.parametrize("body", ["gateway: int", "def __init__(self): self.gateway = 3"])
def test_an_attribute_without_a_value_in_the_class_is_told_apart(folder: Any, body: str) -> None:
    text = f"from protocols import Sensor as S\nclass Sensor(S):\n    {body}\n    gate = 1\n"
    folder.write("others.py", text)
    added = '*.buoy.protocol.class = "others.py:Sensor"\n*.buoy.protocol.gateway = 1\n'
    assert folder.error(added) == (
        "test.ini:7: `gateway` is no parameter of Sensor, it has no value in the class, such as"
        " `gateway = 0`; expected one of class, gate, typename"
    )


def test_an_attribute_that_is_none_in_the_class_is_told_apart(folder: Any) -> None:
    text = "from protocols import Sensor as S\nclass Sensor(S):\n    gateway: int | None = None\n"
    folder.write("others.py", text)
    added = '*.buoy.protocol.class = "others.py:Sensor"\n*.buoy.protocol.gateway = 1\n'
    assert folder.error(added) == (
        "test.ini:7: `gateway` is no parameter of Sensor, its value in the class is None, and none such as"
        " `gateway = 0`; expected one of class, typename"
    )


@pytest.mark.parametrize(("name", "made"), [("boat", "boat"), ("boat*", "uav")])
def test_without_any_node_what_makes_one_is_told(folder: Any, name: str, made: str) -> None:
    folder.write("test.ini", f"[General]\nsim-time-limit = 1s\n*.{name}.mobility.initialX = 3m\n")
    with pytest.raises(ConfigError) as caught:
        load_scenarios(folder.ini)
    assert str(caught.value) == (
        f"{folder.ini}:3: `*.{name}.mobility.initialX` matches no node; expected a line that makes one,"
        f' such as `*.{made}.protocol.class = "file.py:Class"`'
    )


def test_a_forgotten_index_is_told_even_if_another_name_is_more_like_it(folder: Any) -> None:
    added = '*.tx.protocol.class = "protocols.py:Sensor"\n*.numRx = 2\n*.rx.mobility.speed = 1mps\n'
    added += '*.rx[*].protocol.class = "protocols.py:Sensor"\n'
    assert folder.error(added) == (
        "test.ini:8: `*.rx.mobility.speed` matches no parameter; expected the name of one; "
        "did you mean `*.rx[*].mobility.speed`?"
    )


def test_a_misspelt_number_of_nodes(folder: Any) -> None:
    assert folder.error("*.numUavz = 1\n") == (
        "test.ini:6: nothing says which protocol uavz[0] runs; "
        'expected `*.uavz[*].protocol.class = "file.py:Class"`; did you mean `*.numUavs`?'
    )
