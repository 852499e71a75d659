"""Flying nodes, against INET: messages that a receiver gets while it flies past a sender."""

from collections.abc import Callable
from functools import cache
from typing import cast

from verification.finding import Finding
from verification.reference_data import rows
from verification.reference_run import run_reference
from verification.sampling import fisher_p, least_p

FIRST_SEND_S, INTERVAL_S = 1.0, 0.01
SEEDS = range(3)


@cache
def heard(config: str, seed: int = 0) -> list[list[int]]:
    """Return the numbers of the received messages, for each receiver."""
    result = run_reference("flyby", config, seed=seed)
    times = [
        cast("list[float]", node.tracked_variables["received_at"])
        for node in result.nodes
        if node.name.startswith("receivers")
    ]
    # A message arrives less than a millisecond after it was sent.
    return [[int((time - FIRST_SEND_S) / INTERVAL_S + 1e-6) for time in at_one] for at_one in times]


def test_within_reach_every_message_of_inets_is_heard_and_no_other(report: Callable[[Finding], None]) -> None:
    theirs = [
        list(range(int(row["first"]), int(row["last"]) + 1))
        for row in rows("inet_flyby", case="FlybySensitivity")
    ]
    differing = sum(
        len(set(ours) ^ set(inets)) for ours, inets in zip(heard("FlybySensitivity"), theirs, strict=True)
    )
    report(
        Finding(
            "eight receivers that fly past a flying sender at 10 m/s to 38 m/s, sensitivity: messages heard, "
            "one by one, against INET",
            f"{differing} of {sum(map(len, theirs))} differ",
            "0",
            "nothing is random",
            differing == 0,
        )
    )


def test_over_a_noisy_link_as_many_messages_are_heard_at_every_place(
    report: Callable[[Finding], None],
) -> None:
    numbers = [number for seed in SEEDS for at_one in heard("FlybyNoise", seed) for number in at_one]
    receivers = len(heard("FlybyNoise"))
    p_values = {}
    for row in rows("inet_flyby", case="FlybyNoise"):
        first, last = int(row["first"]), int(row["last"])
        sent = receivers * (last - first + 1)
        ours = sum(first <= number <= last for number in numbers)
        p_values[first] = fisher_p(ours, len(SEEDS) * sent, int(row["received"]), sent)
    worst = min(p_values, key=lambda first: p_values[first])
    limit = least_p(len(p_values))
    report(
        Finding(
            "forty receivers that fly past a sender at 10 m/s, noise: share of messages heard in each of 50 "
            "stretches of 2 m, against INET",
            f"least p-value {p_values[worst]:.2g} of {len(p_values)} (message {worst} on)",
            f"p ≥ {limit:.2g} for each",
            "sampling error at 99 % for all together (Fisher's exact test, Bonferroni; INET's 800 messages "
            f"in each stretch against our {len(SEEDS) * 800})",
            p_values[worst] >= limit,
        )
    )
