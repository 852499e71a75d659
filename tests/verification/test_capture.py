"""A strong and a weak frame overlap at a receiver with preamble detection: its receptions, against ns-3."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from gradysim.scenario.parse.ini import read_ini
from gradysim.scenario.parse.sections import config_names
from verification.finding import Finding
from verification.reference_data import Row, rows
from verification.reference_run import FOLDER, run_reference, tracked
from verification.sampling import fisher_p, least_p

if TYPE_CHECKING:
    from matplotlib.axes import Axes

pytestmark = pytest.mark.verify

STRONG_BYTES, WEAK_BYTES = 36, 37
INTERVAL_S = 0.01
OFFSETS_US = ("-30", "-18", "-10", "-5", "-3", "0", "3", "5", "18", "30")
DIFFERENCES_DB = {
    "6": {*range(8)},
    "24": {0, 3, *range(6, 14), 24, 30},
    "54": {0, 3, 6, *range(18, 25), 30},
}
"""{rate in Mbps: differences of the powers}: those at which a frame may be lost, and some others."""


@cache
def measure(config: str, diff_db: int, pairs: int, seed: int) -> tuple[int, int]:
    """Return the strong and weak frames that the receiver got."""
    end_s = 1 + pairs * INTERVAL_S
    result = run_reference(
        "capture",
        config,
        run=diff_db,
        seed=seed,
        overrides=[f"**.protocol.stop = {end_s - INTERVAL_S / 2}s", f"sim-time-limit = {end_s}s"],
    )
    assert tracked(result, "sent") == [pairs, pairs]
    (received,), (size,) = (tracked(result, name, "receiver") for name in ("received", "received_bytes"))
    weak = size - STRONG_BYTES * received
    assert WEAK_BYTES - STRONG_BYTES == 1
    return received - weak, weak


def config_of(row: Row) -> str:
    """Return the configuration of a row; it has one run for each difference."""
    offset_us = int(row["offset_us"])
    when = f"{'Earlier' if offset_us < 0 else 'Later'}{abs(offset_us)}us" if offset_us else "AtOnce"
    return f"Rate{row['bitrate_mbps']}{'FrameCapture' if row['frame_capture'] == '1' else ''}{when}"


def test_each_row_has_its_run() -> None:
    configs = {config_of(row) for row in rows("ns3_capture")}
    assert configs <= set(config_names(read_ini(FOLDER / "capture.ini")))
    assert len(rows("ns3_capture")) == 31 * len(configs)


def test_outcomes_are_those_of_ns3(
    report: Callable[[Finding], None], picture: Callable[[str, Callable[[Path], None]], None]
) -> None:
    picture("capture.png", draw)
    pairs = 500
    table = [
        row
        for row in rows("ns3_capture")
        if row["offset_us"] in OFFSETS_US
        and int(row["diff_db"]) in DIFFERENCES_DB[row["bitrate_mbps"]]
        and (row["diff_db"], row["frame_capture"]) != ("5", "1")  # the margin itself: rounding decides
    ]
    p_values = []
    for index, row in enumerate(table):
        ours = measure(config_of(row), int(row["diff_db"]), pairs, seed=index)
        frames = int(row["frames"])
        for count, ratio in zip(ours, (row["strong_ratio"], row["weak_ratio"]), strict=True):
            p_values.append(fisher_p(count, pairs, round(float(ratio) * frames), frames))
    limit = least_p(len(p_values))
    report(
        Finding(
            "preamble detection and frame capture, 6, 24 and 54 Mbps, against ns-3",
            f"least p-value {min(p_values):.2g} of {len(p_values)}",
            f"p ≥ {limit:.2g} for each",
            "sampling error at 99 % for all together (Fisher's exact test, Bonferroni; ns-3's 200 pairs "
            f"against our {pairs}): false alarms at most 1 %",
            min(p_values) >= limit,
        )
    )


def draw(path: Path) -> None:
    from verification.figure import NS3, OURS, save

    def panel(offset_us: str, frame_capture: int) -> "Callable[[Axes], None]":
        def draw_panel(axes: "Axes") -> None:
            table = rows("ns3_capture", bitrate_mbps=6, offset_us=offset_us, frame_capture=frame_capture)
            table = [row for row in table if int(row["diff_db"]) <= 12]
            ours = [measure(config_of(row), int(row["diff_db"]), 500, seed=0) for row in table]
            differences = [int(row["diff_db"]) for row in table]
            for which, column, style in ((0, "strong_ratio", "o"), (1, "weak_ratio", "s")):
                name = column.partition("_")[0]
                theirs = [float(row[column]) for row in table]
                axes.plot(differences, theirs, style, color=NS3, ms=7, mfc="none", label=f"ns-3, {name}")
                shares = [counts[which] / 500 for counts in ours]
                axes.plot(differences, shares, style + "-", color=OURS, ms=3, lw=1, label=f"gradysim, {name}")
            axes.set(xlabel="difference of powers (dB)", ylabel="share received", ylim=(-0.05, 1.05))
            when = f"strong one {-int(offset_us)} µs later" if offset_us != "5" else "strong one 5 µs earlier"
            axes.set_title(f"{when}, {'with' if frame_capture else 'without'} capture", fontsize=9)
            axes.legend(fontsize=7)

        return draw_panel

    save(
        path,
        "Two frames of 100 B that overlap, 6 Mbps, with ns-3's table of error rates",
        panel("5", 0),
        panel("-3", 0),
        panel("-10", 0),
        panel("-10", 1),
        columns=2,
    )
