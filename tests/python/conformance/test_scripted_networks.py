"""On a perfect channel both modes call the same protocols with the same arguments at the same times.

At equal times there are corner cases of the order that the modes do not share. These tests leave them out:
see docs/decisions/0015-order-within-one-instant.md.
"""

import math
from collections.abc import Sequence

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from perfect_channel import Case
from scripted import TICKS_PER_S, Action, Script, play

from gradysim.protocol.position import Position

KINDS = ["broadcast", "unicast", "schedule", "schedule", "cancel", "draw", "track"]

seeds = st.integers(0, 2**31 - 1)
coordinates = st.integers(-40, 40).map(float)
networks = st.lists(st.tuples(coordinates, coordinates, coordinates), min_size=1, max_size=5)


def scripts(delays: st.SearchStrategy[int]) -> st.SearchStrategy[Script]:
    """Scripts with all actions, and timers that many ticks ahead."""
    actions = st.builds(Action, kind=st.sampled_from(KINDS), number=st.integers(0, 2), delay=delays)
    return st.lists(st.lists(actions, max_size=4), min_size=1, max_size=6)


@given(networks, st.integers(1, 100).map(float), seeds, scripts(st.integers(0, 30)))
def test_the_same_callbacks_in_the_same_order(
    positions: Sequence[Position], range_m: float, seed: int, script: Script
) -> None:
    case = Case(positions, range_m, seed)
    assert play("integrated", case, script) == play("prototype", case, script)


@pytest.mark.parametrize("interval", [1, 5, 25])
def test_telemetry_has_the_same_place_among_them(interval: int) -> None:
    delays = st.just(0) | st.integers(interval + 1, interval + 30)

    @given(networks, seeds, scripts(delays))
    def check(positions: Sequence[Position], seed: int, script: Script) -> None:
        case = Case(positions, seed=seed, telemetry_interval_s=interval / TICKS_PER_S)
        assert play("integrated", case, script) == play("prototype", case, script)

    check()


wide = st.floats(-1e3, 1e3)


@example((0.0, 0.0, 0.0), (30.0, 40.0, 0.0))
@given(st.tuples(wide, wide, wide), st.tuples(wide, wide, wide))
def test_a_receiver_on_the_rim_is_in_range_in_both_modes_or_in_none(here: Position, there: Position) -> None:
    case = Case([here, there], range_m=max(math.dist(here, there), 1e-9))
    script = [[Action("broadcast")]]
    assert play("integrated", case, script) == play("prototype", case, script)
