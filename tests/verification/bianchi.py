"""Bianchi's model of saturation throughput: n stations that always have a frame to send.

Source: G. Bianchi, "Performance analysis of the IEEE 802.11 distributed coordination function", IEEE JSAC
18(3), 2000: the probabilities of sending in a slot and of a collision as functions of each other, and the
resulting throughput. Retries are unlimited, there is no noise, and all stations hear each other.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Timing:
    """Parameters of the channel access; times in seconds."""

    slot_s: float
    success_s: float
    """Data frame, SIFS, ACK and DIFS."""
    collision_s: float
    """Data frame, and the time until backoffs count again."""
    cw_min: int
    """First backoffs are 0 to cw_min slots."""
    doublings: int
    """Number of times the window doubles."""


def send_probability(p: float, timing: Timing) -> float:
    """Return the probability that a station sends in a slot, if its frames collide with probability p."""
    window = timing.cw_min + 1
    # (1 - (2p)^m) / (1 - 2p) as a sum, which is defined for p = 1/2 as well.
    growth = sum((2 * p) ** stage for stage in range(timing.doublings))
    return 2 / (1 + window + p * window * growth)


def collision_probability(stations: int, timing: Timing) -> float:
    """Return the collision probability, by bisection: p = 1 - (1 - send_probability(p))^(n-1)."""
    low, high = 0.0, 1.0
    for _ in range(60):
        p = (low + high) / 2
        if p < 1 - (1 - send_probability(p, timing)) ** (stations - 1):
            low = p
        else:
            high = p
    return (low + high) / 2


def throughput_bps(stations: int, payload_bits: float, timing: Timing) -> float:
    """Return the received payload of all stations together, in bits per second."""
    send = send_probability(collision_probability(stations, timing), timing)
    idle = (1 - send) ** stations
    success = stations * send * (1 - send) ** (stations - 1)
    collision = 1 - idle - success
    mean_s = idle * timing.slot_s + success * timing.success_s + collision * timing.collision_s
    return success * payload_bits / mean_s
