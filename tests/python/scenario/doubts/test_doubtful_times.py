from typing import Any

import pytest

from gradysim.scenario.doubts.doubtful_times import doubtful_times

PROTOCOLS = """
from typing import Annotated
from protocols import Sensor


class Timed(Sensor):
    interval = 1.0
    heartbeatTimeout = 1.0
    jitter = 0.0
    Spread = 0.0
    offset = 0.0
    position_jitter = 0.0
    spacing = 1.0
    lawn_interval: Annotated[float, "m"] = 1.0
    beacon_period: Annotated[float, "s"] = 1.0
    retries = 3
    label = ""
"""


def told(folder: Any, line: str) -> list[str]:
    folder.write("timed.py", PROTOCOLS)
    chosen = '[X]\n*.uavs[*].protocol.class = "timed.py:Timed"\n'
    return list(doubtful_times(folder.load(f"{chosen}{line}\n", "X").nodes))


def test_a_time_in_metres_is_told_once_with_its_line(folder: Any) -> None:
    (text,) = told(folder, "*.uavs[*].protocol.interval = 5m")
    assert text == (
        f"{folder.ini}:8: warning: `interval` is given in `m`, and by its name it is a time;"
        ' a minute is `min` (in Timed, `interval: Annotated[float, "m"]` says that it is none)'
    )


@pytest.mark.parametrize(
    ("value", "unit"), [("5km", "km"), ("2 * 5Hz", "Hz"), ("-3dBm", "dBm"), ("exponential(5km)", "km")]
)
def test_a_time_in_another_unit_is_told_too(folder: Any, value: str, unit: str) -> None:
    (text,) = told(folder, f"*.uavs[*].protocol.interval = {value}")
    assert text.endswith(
        f" warning: `interval` is given in `{unit}`, and by its name it is a time"
        f' (in Timed, `interval: Annotated[float, "{unit}"]` says that it is none)'
    )


@pytest.mark.parametrize("value", ["parentIndex() == 1 ? 5m : 5s", "select(parentIndex(), 5s, 5m)"])
def test_a_time_of_one_node_alone_is_told(folder: Any, value: str) -> None:
    (text,) = told(folder, f"*.uavs[*].protocol.interval = {value}")
    assert "warning: `interval` is given in `m`" in text


@pytest.mark.parametrize("name", ["jitter", "Spread", "offset"])
def test_a_word_that_alone_is_a_time_is_told_too(folder: Any, name: str) -> None:
    (text,) = told(folder, f"*.uavs[*].protocol.{name} = 1m")
    assert f"warning: `{name}` is given in `m`, and by its name it is a time; a minute is `min`" in text


@pytest.mark.parametrize("values", ["${5m, 10m}", "${interval=10s, 5m}", "${5, 10}m", "${5..10 step 5}m"])
def test_a_list_of_values_is_told_too(folder: Any, values: str) -> None:
    assert len(told(folder, f"*.uavs[*].protocol.interval = {values}")) == 1


def test_different_lines_are_told_each(folder: Any) -> None:
    lines = "*.uavs[0].protocol.interval = 5m\n*.uavs[1].protocol.heartbeatTimeout = 2 * 5m"
    assert len(told(folder, lines)) == 2


@pytest.mark.parametrize(
    "line",
    [
        "interval = 5min",
        "jitter = 5min",
        "position_jitter = 5m",
        "interval = 5",
        "interval = ${runnumber}m",
        "interval = ${5min, 10ms, 1 km}",
        "interval = ${5, 10}min",
        "spacing = 5m",
        "lawn_interval = 5m",
        "beacon_period = 5",
        'label = "5m"',
        "retries = 5",
    ],
)
def test_anything_else_is_not_doubted(folder: Any, line: str) -> None:
    assert told(folder, f"*.uavs[*].protocol.{line}") == []
