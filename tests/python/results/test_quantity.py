import dataclasses
import math
from typing import Annotated

import pytest

from gradysim.results.delays import constant_delays
from gradysim.results.quantity import Average, Quantity, Scalar, averages_of, json_object, scalars_of
from gradysim.results.reference import table
from gradysim.results.result import NodeResult, RunResult

NODE = NodeResult(0, "uavs[0]", "Scout", (1.0, 2.0, 3.0), {})
RESULT = RunResult("A", 3, 3, "integrated", 1.5, 0.25, 0.125, 10, False, None, {}, ())


def named(result, network="Network"):
    return {(scalar.module, scalar.name): scalar.value for scalar in result.scalars(network)}


def of_node(**fields):
    result = dataclasses.replace(RESULT, nodes=(dataclasses.replace(NODE, **fields),))
    return {key: value for key, value in named(result).items() if key[0] != "Network"}


def test_of_the_run():
    assert named(RESULT) == {
        ("Network", "simTime"): 1.5,
        ("Network", "wallTime"): 0.25,
        ("Network", "cpuTime"): 0.125,
        ("Network", "event:count"): 10,
        ("Network", "setupTime"): 0.0,
    }


def test_paths_begin_with_the_name_of_the_network():
    assert {module for module, _ in named(RESULT, "Field")} == {"Field"}


def test_outcomes_of_the_network():
    outcomes = {
        "frames": {"unicast overheard": {"below_sensitivity": 2}},
        "messages": {"unicast": {"retry_limit": 4}},
    }
    told = named(dataclasses.replace(RESULT, outcomes=outcomes))
    assert told["Network.radioMedium", "unicastOverheard:belowSensitivity:count"] == 2
    assert told["Network", "unicastMessage:retryLimit:count"] == 4


def test_delays_of_messages():
    told = named(dataclasses.replace(RESULT, message_delays={"unicast": constant_delays({0.1: 1, 0.3: 1})}))
    assert told["Network", "unicastMessage:delay:mean"] == pytest.approx(0.2)
    assert told["Network", "unicastMessage:delay:max"] == 0.3


def test_the_place_of_a_node():
    assert of_node() == {
        ("Network.uavs[0].mobility", "positionX:last"): 1.0,
        ("Network.uavs[0].mobility", "positionY:last"): 2.0,
        ("Network.uavs[0].mobility", "positionZ:last"): 3.0,
    }


def test_tracked_variables_that_are_numbers():
    tracked = {"heard": 5, "state": "up", "on": True, "big": 10**400, 7: 0.5, "far": math.inf, "list": [1]}
    told = of_node(tracked_variables=tracked)
    assert {name: value for (module, name), value in told.items() if module.endswith(".protocol")} == {
        "heard:last": 5.0,
        "on:last": 1.0,
        "7:last": 0.5,
        "far:last": math.inf,
    }


def test_a_variable_that_is_nan_is_told():
    told = of_node(tracked_variables={"rate": math.nan})
    assert math.isnan(told["Network.uavs[0].protocol", "rate:last"])


def test_what_was_asked_for_of_a_node():
    told = of_node(
        frames_by_bitrate={5_500_000: 2, 54_000_000: 3},
        frame_outcomes={"broadcast": {"receiver_locked": 4}},
        interferers={"uavs[1]": 6},
        message_outcomes={"wlan[1]": {"unicast": {"retry_limit": 7}}},
    )
    assert told["Network.uavs[0].wlan[1]", "unicastMessage:retryLimit:count"] == 7
    assert {name: value for (module, name), value in told.items() if module == "Network.uavs[0]"} == {
        "unicast:5.5Mbps:count": 2,
        "unicast:54Mbps:count": 3,
        "broadcast:receiverLocked:count": 4,
        "interferer:uavs[1]:count": 6,
    }


@pytest.mark.parametrize("name", ["positionX:last", "heard:last", "broadcast:delivered:count"])
def test_names_say_how_the_number_was_made(name):
    outcomes = {"frames": {"broadcast": {"delivered": 3}}}
    node = dataclasses.replace(NODE, tracked_variables={"heard": 5})
    result = dataclasses.replace(RESULT, nodes=(node,), outcomes=outcomes)
    (scalar,) = (scalar for scalar in result.scalars("Network") if scalar.name == name)
    source, _, mode = name.rpartition(":")
    assert (scalar.attributes["source"], scalar.attributes["recordingmode"]) == (source, mode)


@dataclasses.dataclass(frozen=True)
class Counted:
    """A result with one number."""

    hops: Annotated[int, Quantity("Hops.", unit="m", scalar="hops:max", summary="hops", mean="hops in m")]
    secret: Annotated[int, Quantity("Not in JSON.", in_json=False)] = 0


def test_a_number_appears_everywhere_from_its_declaration():
    assert json_object(Counted(3)) == {"hops": 3}
    attributes = {"unit": "m", "source": "hops", "recordingmode": "max"}
    assert list(scalars_of(Counted(3), "N")) == [Scalar("N", "hops:max", 3, attributes)]
    assert list(averages_of(Counted, {"hops": 3})) == [Average("hops in m", 3)]
    assert "| `hops` | Hops. | m | `hops:max` | `hops in m` |" in table(Counted)


def test_a_result_file_of_an_older_version_lacks_numbers():
    assert list(averages_of(Counted, {})) == []
