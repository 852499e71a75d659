"""Broadcasts at random times within milliseconds, under the rules of ns-3: receptions, against ns-3."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from statistics import fmean
from typing import TYPE_CHECKING

import pytest

from verification.finding import Finding
from verification.reference_data import rows
from verification.reference_run import run_reference, tracked
from verification.sampling import least_p, welch_p

if TYPE_CHECKING:
    from matplotlib.axes import Axes

pytestmark = pytest.mark.verify

CASES = [
    *((2, 1), (3, 1), (5, 1), (10, 1), (20, 1), (30, 1), (50, 1)),
    *((5, 10), (10, 10), (20, 10), (30, 10), (50, 10)),
]
"""{nodes, longest delay in ms}: rows of ns-3's table with enough losses to compare."""


@cache
def losses(nodes: int, jitter_ms: int) -> tuple[float, ...]:
    """Return the ratio of lost receptions for each seed; large networks have fewer seeds, to save time."""

    def loss(seed: int) -> float:
        result = run_reference(
            "jittered",
            seed=seed,
            overrides=[f"*.numNodes = {nodes}", f"*.nodes[*].protocol.jitter = {jitter_ms}ms"],
        )
        sent = sum(tracked(result, "sent"))
        assert sent == 300 * nodes
        return 1 - sum(tracked(result, "received")) / (sent * (nodes - 1))

    return tuple(loss(seed) for seed in range(6 if nodes <= 20 else 4))


def ns3_losses(nodes: int, jitter_ms: int) -> tuple[float, ...]:
    table = rows("ns3_jittered", n=nodes, jitter_ms=jitter_ms)
    return tuple(1 - int(row["received"]) / (int(row["sent"]) * (nodes - 1)) for row in table)


@pytest.mark.parametrize(("nodes", "jitter_ms"), CASES)
def test_losses_agree_with_ns3(nodes: int, jitter_ms: int, report: Callable[[Finding], None]) -> None:
    ours, theirs = losses(nodes, jitter_ms), ns3_losses(nodes, jitter_ms)
    p_value = welch_p(ours, theirs)
    limit = least_p(len(CASES))
    report(
        Finding(
            f"broadcasts of {nodes} nodes within {jitter_ms} ms, lost copies, against ns-3 under its rules",
            f"{fmean(ours):.2%} against {fmean(theirs):.2%} (p = {p_value:.2g})",
            f"p ≥ {limit:.2g}",
            f"sampling error at 99 % for all {len(CASES)} together (Welch's t test, Bonferroni)",
            p_value >= limit,
        )
    )


def test_picture(picture: Callable[[str, Callable[[Path], None]], None]) -> None:
    picture("jittered_broadcasts.png", draw)


def draw(path: Path) -> None:
    from verification.figure import NS3, OURS, save

    def panel(axes: "Axes") -> None:
        for jitter_ms, marker in ((1, "s"), (10, "^")):
            sizes = [nodes for nodes, jitter in CASES if jitter == jitter_ms]
            ours = [fmean(losses(nodes, jitter_ms)) for nodes in sizes]
            axes.plot(sizes, ours, marker + "-", color=OURS, ms=4, lw=1, label=f"gradysim, {jitter_ms} ms")
            theirs = [fmean(ns3_losses(nodes, jitter_ms)) for nodes in sizes]
            axes.plot(sizes, theirs, marker + ":", color=NS3, ms=8, mfc="none", label=f"ns-3, {jitter_ms} ms")
        axes.set(xlabel="nodes", ylabel="share of copies lost", xticks=(2, 5, 10, 20, 30, 50))
        axes.legend(fontsize=8)

    save(path, "Broadcasts of 100 B at random times, rules of ns-3", panel, width=6)
