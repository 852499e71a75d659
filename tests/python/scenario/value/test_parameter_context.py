import re

import pytest

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.drawing_functions import DRAWING_FUNCTIONS
from gradysim.scenario.value.parameter_context import ParameterContext, differs_between_parameters
from gradysim.scenario.value.parameter_stream import ParameterStream

PATH = "uavs[3].wlan[1].radio.transmitter.power"


def test_each_draw_has_a_stream_of_its_own() -> None:
    context = ParameterContext(1, PATH)
    assert not context.has_drawn
    numbers = [context.stream(place).uniform() for place in range(2)]
    assert numbers == [ParameterStream(1, PATH, place).uniform() for place in range(2)]
    assert context.has_drawn


def test_levels_are_counted_from_the_module_of_the_parameter() -> None:
    context = ParameterContext(1, PATH)
    assert context.index_of_ancestor(2) == 1
    assert context.index_of_ancestor(3) == 3


@pytest.mark.parametrize(
    ("path", "levels", "message"),
    [
        (PATH, 0, f"`transmitter` in `{PATH}` has no index; that of `uavs[3]` is `ancestorIndex(3)`"),
        (PATH, 4, "there is no module 4 levels above `uavs[3].wlan[1].radio.transmitter`"),
        (PATH, -1, "there is no module -1 levels above `uavs[3].wlan[1].radio.transmitter`"),
        ("uavs[3].mobility.speed", 0, "that of `uavs[3]` is `parentIndex()`"),
        ("uavs[3].numWlanInterfaces", 1, "that of `uavs[3]` is `index`"),
        (
            "uavs[3].wlan[0].radio.channelNumber",
            0,
            "is `ancestorIndex(2)`, that of `wlan[0]` is `parentIndex()`",
        ),
        ("groundStation.mobility.speed", 1, "`groundStation` in `groundStation.mobility.speed` has no index"),
    ],
)
def test_what_has_no_index(path: str, levels: int, message: str) -> None:
    with pytest.raises(BadValue, match=re.escape(message)):
        ParameterContext(1, path).index_of_ancestor(levels)


@pytest.mark.parametrize(
    ("text", "differs"),
    [
        ("5m", False),
        ("5m * index", True),
        ("5m * parentIndex()", True),
        ("ancestorIndex (2)", True),
        ('"index parentIndex()"', False),
        ("indexes", False),
        ("max(1, 2)", False),
        *((f"{name}(1, 2)", True) for name in DRAWING_FUNCTIONS),
    ],
)
def test_knows_values_that_differ_between_parameters(text: str, differs: bool) -> None:
    assert differs_between_parameters(text) is differs
