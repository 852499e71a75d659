"""Transmission power for a range, under the models of a scenario."""

import math
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from numbers import Integral, Real
from typing import TYPE_CHECKING

from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.engine_errors import EngineError, errors_at, text_of
from gradysim.integrated.network import medium_config, node_config, node_settings
from gradysim.integrated.power_for_range import MESSAGE_BYTES, RATIO
from gradysim.integrated.two_ray_ground import ground_hint
from gradysim.scenario.errors import ConfigError, nearest
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.keys import CENTER_FREQUENCY

if TYPE_CHECKING:
    from gradysim._netsim import LinkBudget

CURVE_POINTS = 40
CURVE_END = 2.0
"""End of the curve, as a multiple of the range."""

_LARGE_CHANGE = 0.02
"""Change of the ratio between two points that gets further points in between."""

_AT_ONCE = 1e-9
"""Relative difference of the distances of two points that counts as a step."""

_NOTICED = 1.01
"""The sensitivity limits the range if it needs this many times the power: 0.04 dB, far more than the accuracy
of powers."""


@dataclass(frozen=True)
class Calibration:
    """Power for a range, and the quantities that follow from it.

    Attributes:
        sender: Name of the sending node.
        sender_interfaces: Number of its interfaces.
        receiver: Name of the receiving node; the name of the sender, if the receiver is a copy of it.
            With its interface, `relay.wlan[1]`, unless that is the first one.
        range_m: The wanted range.
        ratio: Ratio of broadcast frames received at the range, > 0 and < 1.
        message_bytes: Length of the message in each frame.
        tx_power_w: Smallest sufficient transmission power.
        bitrate_bps: Bitrate of broadcast frames.
        frame_bytes: Length of the message with all headers.
        snr_at_range: Mean received power over noise at the range, a linear ratio; infinite without noise.
        deciding_sensitivity_w: The receiver's sensitivity if it needs more power than noise and preamble
            detection do; otherwise None.
        curve: Distances in m with the ratio received there, from 0 to 1.
        sender_interface: Index of the interface that sends.
        obstacles_left_out: Number of obstacles that attenuate frames in a run. Calibration ignores them.
        deciding_preamble_w: The smallest power of the receiver's preamble detection if it needs more
            power than noise and sensitivity do; otherwise None.
        is_of_bitrate: Whether the sender has a power for this bitrate alone, so that
            `transmitter.powerByBitrate` has to be changed instead of `transmitter.power`.
        fine_curve: The curve with more points where it is steep, and two points at a step; for example, where
            the power falls below the sensitivity.
    """

    sender: str
    sender_interfaces: int
    receiver: str
    range_m: float
    ratio: float
    message_bytes: int
    tx_power_w: float
    bitrate_bps: float
    frame_bytes: int
    snr_at_range: float
    deciding_sensitivity_w: float | None
    curve: tuple[tuple[float, float], ...]
    sender_interface: int = 0
    obstacles_left_out: int = 0
    deciding_preamble_w: float | None = None
    fine_curve: tuple[tuple[float, float], ...] = ()
    is_of_bitrate: bool = False


def calibrate(
    scenario: Scenario,
    range_m: float,
    *,
    ratio: float = RATIO,
    message_bytes: int = MESSAGE_BYTES,
    sender: str | None = None,
    receiver: str | None = None,
) -> Calibration:
    """Find the transmission power with which the ratio `ratio` of broadcast frames is received at `range_m`.

    Other nodes do not send. Antennas point at each other, and nothing is in between.

    Args:
        scenario: The radios and the medium.
        range_m: Distance between the two nodes, > 0.
        ratio: > 0 and < 1.
        message_bytes: Length of the message in each frame, from 0 to the limit of the MTU.
        sender: Name of a node, or of its interface, `relay.wlan[1]`, by default wlan[0]; None for the first
            node.
        receiver: The same; None for a copy of the sender.

    Raises:
        ConfigError: A name or a value is not valid, the medium has no powers, or no power is sufficient.
        TypeError: A number or a name has a wrong type.
    """
    for argument, value, kind, expected in (
        ("range_m", range_m, Real, "a number of meters"),
        ("ratio", ratio, Real, "a number"),
        ("message_bytes", message_bytes, Integral, "an integer"),
        ("sender", sender, str | None, "the name of a node or interface"),
        ("receiver", receiver, str | None, "the name of a node or interface"),
    ):
        if not isinstance(value, kind):
            raise TypeError(f"{argument} = {value!r:.80}: expected {expected}")
    if not range_m > 0:
        raise ConfigError(f"range_m = {range_m:g} m: expected more than 0 m")
    if not 0 < ratio < 1:
        raise ConfigError(f"ratio = {ratio:g}: expected more than 0 and less than 1")
    whole_sender, from_index = _interface_named(scenario.nodes, sender, "sender")
    from_node = to_node = _with_one_interface(whole_sender, from_index)
    to_name = whole_sender.name
    of_several = [whole_sender.name] if len(whole_sender.wlan) > 1 else []
    if receiver is not None:
        whole_receiver, to_index = _interface_named(scenario.nodes, receiver, "receiver")
        to_node = _with_one_interface(whole_receiver, to_index)
        to_name = f"{to_node.name}.wlan[{to_index}]" if to_index else to_node.name
        of_several += [whole_receiver.name] if len(whole_receiver.wlan) > 1 else []
    if receiver is not None and to_node.id == from_node.id:
        raise ConfigError(
            f"`{receiver}` cannot be the receiver: it is the sender; expected two nodes, or no receiver for"
            " one like the sender"
        )
    try:
        budget = link_budget(scenario, from_node, to_node, message_bytes)
    except EngineError as error:
        if of_several and error.target == CENTER_FREQUENCY.target:
            expected = f"; expected interfaces of one channel, such as {of_several[0]}.wlan[1]"
            raise ConfigError(error.message + expected, error.source) from error
        raise
    try:
        power_w = budget.tx_power_w_for(range_m, ratio)
    except load_netsim().ConfigError as error:  # no power would do
        nodes = [from_node] if to_node.id == from_node.id else [from_node, to_node]
        hint = ground_hint(medium_config(scenario), nodes)
        raise ConfigError(text_of(error) + (f"; {hint}" if hint else "")) from error
    sensitivity_w, preamble_w = _deciding_levels_w(
        scenario, from_node, to_node, message_bytes, range_m, ratio, power_w
    )
    distances = [range_m * CURVE_END * step / CURVE_POINTS for step in range(1, CURVE_POINTS + 1)]
    curve = tuple((distance, budget.reception_ratio(distance, power_w)) for distance in distances)
    return Calibration(
        sender=from_node.name,
        sender_interfaces=len(whole_sender.wlan),
        receiver=to_name,
        range_m=range_m,
        ratio=ratio,
        message_bytes=message_bytes,
        tx_power_w=power_w,
        bitrate_bps=budget.bitrate_bps,
        frame_bytes=budget.psdu_bytes,
        snr_at_range=power_w * budget.mean_gain(range_m) / budget.noise_w if budget.noise_w else math.inf,
        deciding_sensitivity_w=sensitivity_w,
        curve=curve,
        sender_interface=from_index,
        obstacles_left_out=len(scenario.obstacles) if medium_config(scenario).obstacle_loss else 0,
        deciding_preamble_w=preamble_w,
        is_of_bitrate=budget.bitrate_bps in dict(node_config(from_node).wlan[0].radio.tx_power_by_bitrate_w),
        fine_curve=tuple(_refined(curve, lambda distance_m: budget.reception_ratio(distance_m, power_w))),
    )


def _refined(
    curve: Iterable[tuple[float, float]], ratio_at: Callable[[float], float]
) -> Iterator[tuple[float, float]]:
    """Yield the points of a curve, with further points where the ratio changes much."""
    open_ends = list(curve)[::-1]
    near = open_ends.pop()
    yield near
    while open_ends:
        far = open_ends[-1]
        middle_m = (near[0] + far[0]) / 2
        if abs(near[1] - far[1]) > _LARGE_CHANGE and far[0] - near[0] > _AT_ONCE * far[0]:
            open_ends.append((middle_m, ratio_at(middle_m)))
        else:
            near = open_ends.pop()
            yield near


def _deciding_levels_w(
    scenario: Scenario,
    sender: NodeSpec,
    receiver: NodeSpec,
    message_bytes: int,
    range_m: float,
    ratio: float,
    power_w: float,
) -> tuple[float | None, float | None]:
    """Return the receiver's sensitivity or smallest preamble power, if it limits the range; else None."""
    unlimited = node_config(receiver)
    radio = unlimited.wlan[0].radio
    sensitivity_w = radio.sensitivity_w
    preamble_w = radio.preamble_minimum_power_w if radio.preamble_detection else 0.0
    radio.sensitivity_w = sys.float_info.min
    radio.preamble_minimum_power_w = 0.0
    budget = load_netsim().LinkBudget(medium_config(scenario), node_config(sender), unlimited, message_bytes)
    if power_w <= _NOTICED * budget.tx_power_w_for(range_m, ratio):
        return None, None
    return (sensitivity_w, None) if sensitivity_w >= preamble_w else (None, preamble_w)


def link_budget(scenario: Scenario, sender: NodeSpec, receiver: NodeSpec, message_bytes: int) -> "LinkBudget":
    """Return the probabilities of a reception from one node to another. Raises ConfigError."""
    with errors_at(node_settings(sender, 0, scenario.medium)):
        budget: LinkBudget = load_netsim().LinkBudget(
            medium_config(scenario), node_config(sender), node_config(receiver), message_bytes
        )
    return budget


def pair_of(scenario: Scenario, sender: str | None, receiver: str | None) -> tuple[NodeSpec, NodeSpec]:
    """Return the nodes of these names, with the named interface alone; see `calibrate`."""
    from_node = _with_one_interface(*_interface_named(scenario.nodes, sender, "sender"))
    if receiver is None:
        return from_node, from_node
    return from_node, _with_one_interface(*_interface_named(scenario.nodes, receiver, "receiver"))


def _interface_named(nodes: Sequence[NodeSpec], name: str | None, role: str) -> tuple[NodeSpec, int]:
    """Return the node and the index of its interface: `relay` is `relay.wlan[0]`."""
    if name is None:
        return nodes[0], 0
    match = re.fullmatch(r"(.*)\.wlan\[(\d{1,3})\]", name, re.ASCII)
    of_node, index = (match[1], int(match[2])) if match else (name, 0)
    node = next((node for node in nodes if node.name == of_node), None)
    if node is not None and index < len(node.wlan):
        return node, index
    suggestion = ""
    if node is not None:
        has = "wlan[0]" if len(node.wlan) == 1 else f"wlan[0] to wlan[{len(node.wlan) - 1}]"
        reason, expected = "there is no such interface", f"one of those of {node.name}, {has}"
    elif of_group := [node.name for node in nodes if node.group == of_node]:
        reason, expected = "it is a group", f"one of its nodes, such as {of_group[0]}"
    else:
        reason, expected = "there is no such node", f"one such as {nodes[0].name}"
        suggestion = nearest(of_node, [node.name for node in nodes])
    problem = f"`{name}` cannot be the {role}: {reason}"
    raise ConfigError(problem, expected=expected, suggestion=suggestion)


def _with_one_interface(node: NodeSpec, index: int) -> NodeSpec:
    return node if len(node.wlan) == 1 else replace(node, wlan=(node.wlan[index],))
