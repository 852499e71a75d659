"""Unicast that fails, against INET: retry limits, repetitions, queue overflow, duplicates."""

from collections.abc import Callable
from functools import cache
from statistics import fmean

from verification.finding import Finding
from verification.reference_data import rows
from verification.reference_run import run_reference, tracked
from verification.sampling import least_p, weakest, welch_p

EXACT = ("OutOfReach", "OutOfReachRtsCts", "TooFast", "Bursts")
"""Configurations whose counts do not depend on chance."""
NOISY = ("NoisyLink", "NoisyLinkRtsCts")
SATURATED = ("OutOfReachSaturated", "OutOfReachSaturatedRtsCts")
BY_DEFAULT = "**.inetStationRetryCounters = false"
SEEDS = range(10)
COLUMNS = ("messages", "received", "frames", "rts", "given_up", "queue_overflow", "answers", "duplicates")


@cache
def counts(config: str, seed: int, *overrides: str) -> dict[str, int]:
    """Return the quantities of INET's table for the configuration."""
    result = run_reference("unicast_failures", config, seed=seed, overrides=overrides)
    messages, frames = result.outcomes["messages"]["unicast"], result.outcomes["frames"]
    sent = {kind: sum(frames[kind].values()) for kind in ("unicast", "rts", "ack", "cts")}
    (received,) = tracked(result, "received")
    return {
        "messages": sum(messages.values()),
        "received": received,
        "frames": sent["unicast"] + sent["rts"],
        "rts": sent["rts"],
        "given_up": messages["retry_limit"],
        "queue_overflow": messages["queue_overflow"],
        "answers": sent["ack"] + sent["cts"],
        "duplicates": frames["unicast"]["delivered"] - received,
    }


def inet(config: str) -> list[dict[str, int]]:
    """Return INET's counts, for each of its seeds."""
    table = rows("inet_unicast_failures", case=config)
    return [{column: int(row[column]) for column in COLUMNS} for row in table]


def ours(config: str, column: str, *overrides: str) -> list[int]:
    return [counts(config, seed, *overrides)[column] for seed in SEEDS]


def test_where_nothing_is_left_to_chance_all_counts_are_inets(report: Callable[[Finding], None]) -> None:
    differing = [
        f"{config}, {column}"
        for config in EXACT
        for theirs in inet(config)
        for column in COLUMNS
        if counts(config, 0)[column] != theirs[column]
    ]
    report(
        Finding(
            "unicast to a station out of reach, with and without RTS/CTS, to one that gets RTS but no data, "
            "and in bursts larger than the queue: what was sent, repeated, given up, dropped, against INET",
            f"{len(differing)} of {len(EXACT) * len(COLUMNS)} counts differ {', '.join(differing)}".strip(),
            "0",
            "nothing that is counted is random",
            not differing,
        )
    )


def test_over_a_noisy_link_counts_agree_with_inets_five_seeds(report: Callable[[Finding], None]) -> None:
    columns = [column for column in COLUMNS if column not in ("messages", "queue_overflow")]
    found = {
        (config, column): welch_p(ours(config, column), [run[column] for run in inet(config)])
        for config in NOISY
        for column in columns
        if (config, column) != ("NoisyLink", "rts")
    }
    (config, column), p = weakest(found)
    limit = least_p(len(found))
    report(
        Finding(
            "unicast over a link that loses frames, RTS, CTS and ACKs, with and without RTS/CTS: messages "
            "received and given up, frames, RTS, answers, duplicates, against INET",
            f"least p-value {p:.2g} of {len(found)} ({config}, {column.replace('_', ' ')})",
            f"p ≥ {limit:.2g} for each",
            "sampling error at 99 % for all together (Welch's t test, Bonferroni; INET's 5 seeds of 2000 "
            f"messages against our {len(SEEDS)}); one retry less gives up 39 % more",
            p >= limit,
        )
    )


def test_saturated_with_messages_to_nobody_counts_agree_with_inet(report: Callable[[Finding], None]) -> None:
    found = {
        (config, column): (ours(config, column), [run[column] for run in inet(config)])
        for config in SATURATED
        for column in ("frames", "given_up", "queue_overflow")
    }
    limit = least_p(len(found))
    least = min(welch_p(*samples) for samples in found.values())
    (config, column), worst = max(
        ((key, fmean(ours_) / fmean(theirs) - 1) for key, (ours_, theirs) in found.items()),
        key=lambda item: abs(item[1]),
    )
    by_default = fmean(ours(SATURATED[0], "frames", BY_DEFAULT)) / fmean(found[SATURATED[0], "frames"][1])
    report(
        Finding(
            "unicast to a station out of reach, a message every 5 ms, a queue of five, INET's contention "
            "window: frames, messages given up and dropped, against INET",
            f"differ by at most {worst:+.2%} ({config}, {column.replace('_', ' ')}); least p-value "
            f"{least:.2g}; by default {by_default:.1f} times as many frames",
            f"p ≥ {limit:.2g} for each of the {len(found)}",
            "sampling error at 99 % for all together (Welch's t test, Bonferroni)",
            least >= limit,
        )
    )
