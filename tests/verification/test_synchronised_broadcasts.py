"""Broadcasts at the same instant: no receptions, as in both references."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from statistics import fmean
from typing import TYPE_CHECKING

from verification.finding import Finding
from verification.reference_data import rows
from verification.reference_run import run_reference, tracked

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CONFIGS = {0: "General", 1: "Jittered1ms", 10: "Jittered10ms", 100: "Jittered100ms"}
BROADCASTS = 20


@cache
def received_at_once(nodes: int) -> tuple[int, int]:
    """Return the frames sent and received when all nodes send 20 times at the same instant."""
    result = run_reference(
        "synchronised",
        overrides=[
            f"*.numNodes = {nodes}",
            f"*.nodes[*].protocol.stop = {BROADCASTS + 0.5}s",
            f"sim-time-limit = {BROADCASTS + 1}s",
        ],
    )
    return sum(tracked(result, "sent")), sum(tracked(result, "received"))


def test_nobody_receives_what_all_send_at_once(
    report: Callable[[Finding], None], picture: Callable[[str, Callable[[Path], None]], None]
) -> None:
    picture("synchronised_broadcasts.png", draw)
    counts = {nodes: received_at_once(nodes) for nodes in range(2, 51)}
    assert all(sent == nodes * BROADCASTS for nodes, (sent, _) in counts.items())
    assert all(int(row["received"]) == 0 for row in rows("ns3_synchronised", offset_ms=0))
    received = sum(received for _, received in counts.values())
    report(
        Finding(
            "broadcasts at the same instant, 2 to 50 nodes, against INET and ns-3",
            f"{received} of {sum(sent for sent, _ in counts.values())} broadcasts received by anybody",
            "0",
            "nothing here is random: a radio that transmits hears nothing",
            received == 0,
        )
    )


def draw(path: Path) -> None:
    from verification.figure import NS3, OURS, save

    sizes = (2, 3, 5, 10, 20)

    def ratio(offset_ms: int, nodes: int) -> float:
        """Return the ratio of receptions, with seeds 0 to 4."""
        shares = []
        for seed in range(5 if offset_ms else 1):
            result = run_reference(
                "synchronised", CONFIGS[offset_ms], seed=seed, overrides=[f"*.numNodes = {nodes}"]
            )
            shares.append(sum(tracked(result, "received")) / (sum(tracked(result, "sent")) * (nodes - 1)))
        return fmean(shares)

    def ns3_ratio(offset_ms: int, nodes: int) -> float:
        runs = rows("ns3_synchronised", offset_ms=offset_ms, n=nodes)
        return fmean(int(row["received"]) / (int(row["sent"]) * (nodes - 1)) for row in runs)

    def panel(axes: "Axes") -> None:
        for offset_ms, marker in zip(CONFIGS, "os^D", strict=True):
            label = f"offsets up to {offset_ms} ms" if offset_ms else "same instant"
            ours = [ratio(offset_ms, nodes) for nodes in sizes]
            axes.plot(sizes, ours, marker + "-", color=OURS, ms=4, lw=1, label=f"gradysim, {label}")
            theirs = [ns3_ratio(offset_ms, nodes) for nodes in sizes]
            axes.plot(sizes, theirs, marker + ":", color=NS3, ms=7, lw=1, mfc="none", label=f"ns-3, {label}")
        axes.set(xlabel="nodes", ylabel="share of copies received", ylim=(-0.03, 1.03), xticks=sizes)
        axes.legend(fontsize=7.5, loc="center left", bbox_to_anchor=(1.0, 0.5))

    save(path, "Broadcasts of 100 B at 6 Mbps once a second, constant random offsets", panel, width=7.0)
