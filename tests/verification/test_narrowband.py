"""IEEE 802.15.4 against exact sums of its times and the distribution of its first backoff.

The reference values are exact and independent of the engine: sums of the durations of the standard, and the
distribution of the minimum of n numbers.

Goodput: a cycle is backoff (0 to 7 periods of 320 us), assessment (128 us), turnaround (192 us), frame
(192 us + 32 us for each byte) and, with ACKs, 192 us + 352 us.

Contention: n devices start at the same instant and assess the channel once. Those with the smallest number
send. All others find the channel busy, because a frame is longer than seven periods. A message arrives if its
sender alone had the smallest number. Nodes that answer one query have the same contention: C. Buratti,
R. Verdone, "Performance Analysis of IEEE 802.15.4 Non Beacon-Enabled Mode", IEEE Transactions on Vehicular
Technology 58 (2009).
"""

from collections.abc import Callable
from math import sqrt

import pytest

from verification.finding import Finding
from verification.reference_run import run_reference, tracked

WINDOW = 8
ROUNDS = 2000


def cycle_s(payload_bytes: int, acks: bool) -> float:
    """Return the mean time from one message to the next, without losses and propagation."""
    frame_us = 192 + 32 * (37 + payload_bytes)
    return (320 * (WINDOW - 1) / 2 + 128 + 192 + frame_us + (544 if acks else 0)) * 1e-6


def alone(senders: int) -> float:
    """Return the probability that the smallest of `senders` numbers from WINDOW was drawn only once."""
    return senders * sum(((WINDOW - 1 - least) / WINDOW) ** (senders - 1) for least in range(WINDOW)) / WINDOW


def mean_with_least(senders: int) -> float:
    """Return the mean number of devices that drew the smallest number."""
    return senders * sum(((WINDOW - least) / WINDOW) ** (senders - 1) for least in range(WINDOW)) / WINDOW


@pytest.mark.parametrize("acks", [True, False])
def test_goodput_of_one_sender(acks: bool, report: Callable[[Finding], None]) -> None:
    worst = 0.0
    for payload_bytes in (10, 40, 90):
        overrides = [
            f"*.senders[*].protocol.payload_bytes = {payload_bytes}",
            f"**.wlan[*].mac.useMACAcks = {str(acks).lower()}",
        ]
        result = run_reference("narrowband", "Goodput", overrides=overrides)
        measured_bps = tracked(result, "received_bytes", "sink")[0] * 8 / result.sim_time_s
        worst = max(worst, abs(measured_bps * cycle_s(payload_bytes, acks) / (8 * payload_bytes) - 1))
    report(
        Finding(
            f"802.15.4: goodput of one sender {'with' if acks else 'without'} ACKs, against the closed form",
            f"differs by at most {worst:.2%} for messages of 10, 40 and 90 B",
            "1 %",
            "4 standard errors of the mean backoff over 60 s are 0.7 % of a cycle",
            worst < 0.01,
        )
    )


@pytest.mark.parametrize("senders", [2, 5, 10, 20])
def test_devices_that_begin_at_once(senders: int, report: Callable[[Finding], None]) -> None:
    result = run_reference("narrowband", "Contention", overrides=[f"*.senders.count = {senders}"])
    messages = result.outcomes["messages"]["broadcast"]
    assert sum(messages.values()) == senders * ROUNDS
    received = tracked(result, "received", "sink")[0] / ROUNDS
    sent = messages["sent"] / ROUNDS
    chance = alone(senders)
    error = sqrt(chance * (1 - chance) / ROUNDS)
    report(
        Finding(
            f"802.15.4: {senders} devices that begin at once, against the closed form",
            f"{received:.4f} messages received per round against {chance:.4f}, "
            f"{sent:.3f} sent against {mean_with_least(senders):.3f}",
            f"{4 * error:.4f}; 6 %",
            "4 standard errors over 2000 rounds, of the share and of the mean: false alarms below 0.1 %",
            abs(received - chance) < 4 * error and abs(sent / mean_with_least(senders) - 1) < 0.06,
        )
    )
