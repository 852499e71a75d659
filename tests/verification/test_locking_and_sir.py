"""Two overlapping frames at one receiver: which one it locks on to, and whether that one survives."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from verification.finding import Finding
from verification.nist import received_power_w, success_probability
from verification.reference_data import Row, rows
from verification.reference_run import load_reference, received_in_error, run_reference, tracked
from verification.sampling import fisher_p, least_p

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PAIRS = 20_000
INTERVAL_S = 0.01
TX_POWER_W = 2e-3
NOISE_W = 1e-14
MPDU_BYTES = 100


@cache
def measure(config: str, seed: int) -> tuple[int, int]:
    """Return the frames that the receiver got, and got in error."""
    end_s = 1 + PAIRS * INTERVAL_S
    result = run_reference(
        "sir",
        config,
        seed=seed,
        overrides=[f"**.protocol.stop = {end_s - INTERVAL_S / 2}s", f"sim-time-limit = {end_s}s"],
    )
    assert tracked(result, "sent") == [PAIRS, PAIRS]
    return tracked(result, "received", "receiver")[0], received_in_error(result)


def config_of(row: Row) -> str:
    """Return the configuration with the conditions of a row."""
    sir_db = f"{float(row['sir_db']):g}".replace(".", "_")
    when = {"-20": "", "0": "AtOnce", "20": "Later"}[row["strong_offset_us"]]
    return f"Rate{row['bitrate_mbps']}Sir{sir_db}{when}"


def measured(index: int, row: Row) -> tuple[int, int]:
    return measure(config_of(row), seed=index)


def test_each_row_has_its_configuration() -> None:
    for row in rows("inet_sir"):
        receiver, weak, strong = load_reference("sir", config_of(row)).nodes
        assert receiver.initial_position[0] == 0
        assert -weak.initial_position[0] == float(row["weak_distance_m"])
        assert strong.initial_position[0] == float(row["strong_distance_m"])
        starts_s = [float(str(node.protocol_parameters["first_send"])) for node in (weak, strong)]
        assert starts_s[1] - starts_s[0] == pytest.approx(float(row["strong_offset_us"]) * 1e-6, abs=1e-12)


def test_counts_agree_with_inet(
    report: Callable[[Finding], None], picture: Callable[[str, Callable[[Path], None]], None]
) -> None:
    picture("locking_and_sir.png", draw)
    p_values = []
    for index, row in enumerate(rows("inet_sir")):
        theirs = int(row["received"]), int(row["received_in_error"])
        p_values += [
            fisher_p(count, 2 * PAIRS, other, 2 * int(row["pairs"]))
            for count, other in zip(measured(index, row), theirs, strict=True)
        ]
    limit = least_p(len(p_values))
    report(
        Finding(
            "locking and signal to interference, 21 rows of received and received in error, against INET",
            f"least p-value {min(p_values):.2g} of {len(p_values)}",
            f"p ≥ {limit:.2g} for each",
            "sampling error at 99 % for all together (Fisher's exact test, Bonferroni; INET's 2000 pairs "
            "against our 20,000): false alarms at most 1 %",
            min(p_values) >= limit,
        )
    )


def closed_form(rate_mbps: float, strong_distance_m: float, weak_distance_m: float = 100.0) -> float:
    """Return the probability that the strong frame survives the weak one, which covers nearly all of it."""
    signal_w = received_power_w(TX_POWER_W, strong_distance_m)
    snir = signal_w / (NOISE_W + received_power_w(TX_POWER_W, weak_distance_m))
    return success_probability(rate_mbps, snir, MPDU_BYTES) if snir > 10**0.4 else 0.0


def locked_first() -> list[tuple[int, Row]]:
    """Return rows in which the strong frame comes first and the weak one is above the sensitivity."""
    return [
        (index, row)
        for index, row in enumerate(rows("inet_sir"))
        if row["strong_offset_us"] == "-20" and row["weak_distance_m"] == "100.0"
    ]


def test_the_strong_frame_follows_the_closed_form(report: Callable[[Finding], None]) -> None:
    worst = max(
        abs(
            measured(index, row)[0] / PAIRS
            - closed_form(float(row["bitrate_mbps"]), float(row["strong_distance_m"]))
        )
        for index, row in locked_first()
    )
    report(
        Finding(
            "signal to interference, the strong frame first, against the closed form",
            f"share received differs by at most {worst:.4f} at {len(locked_first())} points",
            "0.015 at every point",
            "4.2 standard errors of a share of one half of 20,000 frames; false alarms below 0.1 %",
            worst <= 0.015,
        )
    )


def draw(path: Path) -> None:
    from verification.figure import INET, MODEL, OURS, save

    def panel(rate: str, low_db: float, high_db: float) -> "Callable[[Axes], None]":
        def draw_panel(axes: "Axes") -> None:
            chosen = [(index, row) for index, row in locked_first() if row["bitrate_mbps"] == rate]
            levels_db = [low_db + (high_db - low_db) * step / 400 for step in range(401)]
            shares = [closed_form(float(rate), 100 * 10 ** (-level / 20)) for level in levels_db]
            axes.plot(levels_db, shares, color=MODEL, lw=1, label="closed form")
            sir_db = [float(row["sir_db"]) for _, row in chosen]
            theirs = [int(row["received"]) / int(row["pairs"]) for _, row in chosen]
            axes.plot(sir_db, theirs, "o", color=INET, ms=7, mfc="none", label="INET 4.5")
            ours = [measured(index, row)[0] / PAIRS for index, row in chosen]
            axes.plot(sir_db, ours, "x", color=OURS, ms=5, label="gradysim")
            axes.set(xlabel="signal to interference (dB)", ylabel="share of strong frames received")
            axes.set_title(f"{rate} Mbps, strong frame 20 µs earlier", fontsize=9)
            axes.legend(fontsize=7.5)

        return draw_panel

    save(
        path,
        "A frame under interference for nearly all its length, 100 B",
        panel("6", 0.5, 6),
        panel("24", 7.5, 16),
    )
