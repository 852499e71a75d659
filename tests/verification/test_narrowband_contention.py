"""Unslotted CSMA/CA of IEEE 802.15.4 under contention: against ns-3, and against a model of INET's rules.

Up to 30 saturated stations around a sink. ns-3 and the standard differ from INET, whose times are our
defaults, in two of them: a long interframe space after each exchange, which INET omits, and the wait for an
ACK. Runs compared with ns-3 have its times; runs compared with the model have those of INET.
"""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from statistics import fmean
from typing import TYPE_CHECKING

import pytest

from verification.finding import Finding
from verification.narrowband_circle import circle
from verification.narrowband_model import Counts, Rules, contend
from verification.reference_data import rows
from verification.reference_run import run_reference, tracked
from verification.sampling import least_p, weakest, welch_p

if TYPE_CHECKING:
    from matplotlib.axes import Axes

pytestmark = pytest.mark.verify

STATIONS = (1, 2, 5, 10, 20, 30)
SEEDS = range(8)
MEASURED_S = 20.0
MESSAGE_KBIT = 40 * 8 / 1000
FRAME_US = 192 + 32 * 77
TOLERANCE = 0.03
TOLERATED = "throughput: 3 %; it, access failures, retries and missing ACKs: sampling error"
REASON = (
    "99 % for all together (Welch's t test, Bonferroni); the standard error of throughput is below 0.5 % up "
    "to 10 stations, at most 1.4 % with 30; a wrong interframe space would change up to 16 % of it"
)

MODEL_STATIONS = (1, 2, 5, 10)
MODEL_SEEDS = range(16)
MODEL_S = 5.0

THROUGHPUT, NO_ACCESS, NO_ACK, FRAMES = "throughput", "no access", "no ACK", "frames per message"
Measured = dict[str, float]
"""Throughput in kbps; per message that was sent or dropped: access failures, missing ACKs and frames."""


@cache
def ours(config: str, acks: bool, stations: int) -> tuple[Measured, ...]:
    """Return our figures for each seed."""
    overrides = circle(stations, acks)

    def measure(seed: int) -> Measured:
        result = run_reference("narrowband_contention", config, seed=seed, overrides=overrides)
        outcomes = result.outcomes["messages"]["unicast"]
        no_access, no_ack = outcomes["channel_access_failure"], outcomes["retry_limit"]
        done = outcomes["sent"] + outcomes["acknowledged"] + no_access + no_ack
        return {
            THROUGHPUT: tracked(result, "received", "sink")[0] * MESSAGE_KBIT / MEASURED_S,
            NO_ACCESS: no_access / done,
            NO_ACK: no_ack / done,
            FRAMES: sum(result.outcomes["frames"]["unicast"].values()) / done,
        }

    return tuple(map(measure, SEEDS))


@cache
def ns3(overlap: str, acks: bool, stations: int) -> tuple[Measured, ...]:
    return tuple(
        {
            THROUGHPUT: int(row["received"]) * MESSAGE_KBIT / float(row["measured_s"]),
            NO_ACCESS: int(row["access_failures"]) / int(row["messages"]),
            NO_ACK: int(row["no_acks"]) / int(row["messages"]),
            FRAMES: int(row["frames"]) / int(row["messages"]),
        }
        for row in rows("ns3_narrowband_contention", overlap=overlap, acks=int(acks), n=stations)
    )


@cache
def model(rules: Rules, stations: int) -> tuple[Measured, ...]:
    def measure(seed: int) -> Measured:
        counts: Counts = contend(stations, FRAME_US, rules, MODEL_S, seed)
        return {
            THROUGHPUT: counts.received * MESSAGE_KBIT / MODEL_S,
            NO_ACCESS: counts.failed_access / counts.done,
            NO_ACK: counts.failed_retries / counts.done,
            FRAMES: counts.frames / counts.done,
        }

    return tuple(map(measure, MODEL_SEEDS))


def mean(runs: tuple[Measured, ...], quantity: str) -> float:
    return fmean(run[quantity] for run in runs)


def p_value(some: tuple[Measured, ...], other: tuple[Measured, ...], quantity: str) -> float:
    return welch_p([run[quantity] for run in some], [run[quantity] for run in other])


def chance_decides(acks: bool, stations: int) -> list[str]:
    """Return the quantities that differ between runs."""
    if stations == 1:
        return [THROUGHPUT]
    return [THROUGHPUT, NO_ACCESS, NO_ACK, FRAMES] if acks else [THROUGHPUT, NO_ACCESS]


def compare(
    pairs: dict[int, tuple[tuple[Measured, ...], tuple[Measured, ...]]], acks: bool
) -> tuple[str, bool]:
    """Return the number of a finding, from two sets of runs per number of stations, and its verdict."""
    off = {n: mean(a, THROUGHPUT) / mean(b, THROUGHPUT) - 1 for n, (a, b) in pairs.items()}
    worst = max(off, key=lambda n: abs(off[n]))
    chances = {
        (n, quantity): p_value(*pairs[n], quantity) for n in pairs for quantity in chance_decides(acks, n)
    }
    (n, quantity), least = weakest(chances)
    number = (
        f"throughput differs by at most {off[worst]:+.2%} ({worst} stations); least p-value {least:.2g} of "
        f"{len(chances)} ({quantity}, {n} stations)"
    )
    return number, abs(off[worst]) <= TOLERANCE and least >= least_p(len(chances))


@pytest.mark.parametrize("acks", [False, True])
@pytest.mark.parametrize(("overlap", "config"), [("lost", "Ns3"), ("decoded", "Ns3Decoding")])
def test_it_agrees_with_ns3(overlap: str, config: str, acks: bool, report: Callable[[Finding], None]) -> None:
    number, agrees = compare({n: (ours(config, acks, n), ns3(overlap, acks, n)) for n in STATIONS}, acks)
    what = "whatever overlaps is lost" if overlap == "lost" else "bit errors decide what overlaps"
    report(
        Finding(
            f"802.15.4: contention of 1 to 30 stations {'with' if acks else 'without'} ACKs, {what}, "
            "against ns-3 under its times",
            number,
            TOLERATED,
            REASON,
            agrees,
        )
    )


@pytest.mark.parametrize("acks", [False, True])
def test_it_agrees_with_the_model_of_inet(acks: bool, report: Callable[[Finding], None]) -> None:
    rules = Rules(acks, rest_us=0, ack_wait_us=560)
    number, agrees = compare({n: (ours("Inet", acks, n), model(rules, n)) for n in MODEL_STATIONS}, acks)
    report(
        Finding(
            f"802.15.4: contention of 1 to 10 stations {'with' if acks else 'without'} ACKs, INET's times, "
            "against a model of its rules",
            number,
            TOLERATED,
            REASON,
            agrees,
        )
    )


@pytest.mark.parametrize("acks", [False, True])
def test_the_model_agrees_with_ns3(acks: bool) -> None:
    rules = Rules(acks, rest_us=640, ack_wait_us=864)
    number, agrees = compare({n: (model(rules, n), ns3("lost", acks, n)) for n in MODEL_STATIONS}, acks)
    assert agrees, number


@pytest.mark.parametrize("acks", [False, True])
def test_starting_over_as_inet_does_changes_no_throughput(acks: bool) -> None:
    def received(gives_up: bool) -> int:
        rules = Rules(acks, rest_us=0, ack_wait_us=560, gives_up_new_frames=gives_up)
        return contend(5, FRAME_US, rules, MODEL_S, seed=0).received

    assert received(gives_up=True) == received(gives_up=False)


def test_picture(picture: Callable[[str, Callable[[Path], None]], None]) -> None:
    picture("narrowband_contention.png", draw)


def draw(path: Path) -> None:
    from verification.figure import INET, NS3, OURS, save

    def panel(quantity: str, acks: bool) -> Callable[["Axes"], None]:
        def draw_panel(axes: "Axes") -> None:
            def curve(runs: dict[int, tuple[Measured, ...]], style: str, label: str, color: str) -> None:
                values = [mean(of_n, quantity) for of_n in runs.values()]
                axes.plot(list(runs), values, style, color=color, mfc="none", lw=1, label=label)

            for overlap, config, style in (("lost", "Ns3", "-"), ("decoded", "Ns3Decoding", "--")):
                curve({n: ours(config, acks, n) for n in STATIONS}, style, f"gradysim, {overlap}", OURS)
                curve({n: ns3(overlap, acks, n) for n in STATIONS}, "o", f"ns-3, {overlap}", NS3)
            rules = Rules(acks, rest_us=0, ack_wait_us=560)
            curve({n: ours("Inet", acks, n) for n in STATIONS}, ":", "gradysim, INET's times", OURS)
            curve({n: model(rules, n) for n in MODEL_STATIONS}, "x", "model of INET's rules", INET)
            axes.set(xlabel="stations", title=f"{'with' if acks else 'without'} ACKs", ylim=(0, None))
            axes.set_ylabel("throughput in kbps" if quantity == THROUGHPUT else "messages without access")
            if not acks:
                axes.legend(fontsize=7)

        return draw_panel

    panels = [panel(quantity, acks) for quantity in (THROUGHPUT, NO_ACCESS) for acks in (False, True)]
    save(path, "IEEE 802.15.4: saturated stations around a sink, frames of 77 B", *panels, columns=2)
