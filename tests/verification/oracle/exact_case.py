"""Cases by seed in which thresholds are met exactly and events share an instant.

All powers and ratios are powers of two. All nodes are at one place, without losses, or at equal distances,
with equal losses. So rounding does not affect "at least" and "more than". Frames are equally long, and start
so that ends meet starts.
"""

from dataclasses import replace
from random import Random

from verification.oracle.case import (
    BREAKPOINT,
    IEEE80211,
    NARROWBAND,
    Air,
    Case,
    FrameCapture,
    Point,
    PreambleDetection,
    Receiver,
    Send,
    Station,
)
from verification.oracle.physics import frame_format
from verification.oracle.random_case import (
    BANDWIDTH_HZ,
    CARRIERS_HZ,
    DEAF_W,
    RATES_MBPS,
)

PAYLOAD_BYTES, HEADERS_BYTES = 36, 64
BURST_NS = 8_000_000
BREAKPOINT_M = BREAKPOINT[0]


def exact_case(seed: int) -> Case:
    """Return the case of that seed: one station listens, the others send, one of them after sensing."""
    draw = Random(seed)
    op_mode = draw.choice(list(RATES_MBPS))
    rate_mbps = draw.choice(RATES_MBPS[op_mode])
    distance_m = draw.choice([0.0, 0.0, BREAKPOINT_M, 37.0])
    medium = NARROWBAND if distance_m == BREAKPOINT_M else IEEE80211
    # Equal distances: the gain of all signals is the same, but not a power of two.
    receiver = _receiver(draw)
    noise_w = 2.0 ** -draw.randint(1, 6)
    if distance_m > 0:
        noise_w = 1e-12
        receiver = replace(receiver, sensitivity_w=1e-12, preamble_detection=None)
    air = Air(
        medium=medium,
        free_space_alpha=None if medium == NARROWBAND else 2.0,
        breakpoint=BREAKPOINT,
        noise_w=noise_w,
        temperature_k=None,
    )
    listener = Station((0.0, 0.0, 0.0), 1.0, CARRIERS_HZ[0], BANDWIDTH_HZ, op_mode, rate_mbps, receiver)
    frame_us = frame_format(op_mode, rate_mbps, PAYLOAD_BYTES + HEADERS_BYTES).duration_us
    offsets_us = [0, *draw.choices([4, 16, 20, 192, frame_us, frame_us - 4], k=2)]
    senders = [_sender(draw, listener, place, offsets_us) for place in _cross(distance_m)]
    # It may have to wait. It comes before the others, since its grant is older at equal times.
    energy_w = noise_w + sum(draw.sample([1.0, 0.5, 0.25, 0.125], k=draw.randint(1, 2)))
    watcher = replace(senders.pop(), receiver=Receiver(DEAF_W, energy_w, 1.0))
    return Case(seed, 2346, air, (listener, watcher, *senders))


def _power_of_two(draw: Random) -> float:
    return 2.0 ** -draw.randint(0, 3)


def _receiver(draw: Random) -> Receiver:
    return Receiver(
        sensitivity_w=_power_of_two(draw),
        energy_detection_w=DEAF_W,
        snir_threshold=2.0 ** draw.randint(0, 4),
        by_chunks=draw.random() < 0.3,
        preamble_detection=PreambleDetection(
            threshold=2.0 ** draw.randint(-1, 2), minimum_power_w=_power_of_two(draw), duration_us=4
        )
        if draw.random() < 0.4
        else None,
        frame_capture=FrameCapture(margin=2.0 ** draw.randint(0, 2), window_us=draw.choice([4, 16, 20]))
        if draw.random() < 0.4
        else None,
    )


def _cross(distance_m: float) -> list[Point]:
    d = distance_m
    return [(d, 0.0, 0.0), (-d, 0.0, 0.0), (0.0, d, 0.0), (0.0, 0.0, -d)]


def _sender(draw: Random, like: Station, place: Point, offsets_us: list[int]) -> Station:
    """Deaf, and silent until its last message is sent: it always sends at once."""
    sends = tuple(
        Send(burst * BURST_NS + sum(draw.choices(offsets_us, k=2)) * 1000, PAYLOAD_BYTES, None)
        for burst in range(1, 9)
        if draw.random() < 0.6
    )
    return replace(
        like,
        position=place,
        tx_power_w=_power_of_two(draw),
        receiver=Receiver(DEAF_W, DEAF_W, 1.0),
        sends=sends,
    )
