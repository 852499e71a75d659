"""Each measured figure of docs/explanation/what-is-true.md is in its statement of the verification."""

import re
from pathlib import Path

from python.house.verified import FIGURE, repeats

SOURCES = {
    "obstacles": ["the shadow of two boxes"],
    "noise and bit errors, 802.11": [
        "reception over distance, 12 rates",
        "NIST error model at 1, 6 and 24 Mbps, 100 B",
    ],
    "interference, sum of all frames": ["6000 random networks"],
    "DCF: DIFS, backoff, ACK, retries": [
        "saturation throughput, 1 to 30 stations at 6, 11, 24 and 54 Mbps, against INET",
        "saturation throughput of 802.11a at 6 and 54 Mbps, 1 to 30 stations, with as_ns3.ini",
    ],
    "EIFS": ["with INET's EIFS, 100 seeds"],
    "RTS/CTS, NAV, hidden stations": [
        "17 saturated networks with as_ns3.ini",
        "with INET's contention window: messages received",
        "with INET's contention window: messages received",
    ],
    "rate control": ["throughput with ArfRateControl", "throughput with AarfRateControl"],
    "802.15.4 without beacons": [
        "1 to 20 stations with ACKs, whatever overlaps is lost, against INET",
        "1 to 30 stations with ACKs, whatever overlaps is lost, against ns-3",
    ],
    "moving nodes": ["eight receivers that fly past"],
}
"""{effect: a phrase of the statement with each figure, in the order of the row}."""


def test_the_measured_figures_are_those_of_their_statements(root: Path) -> None:
    page = (root / "docs/explanation/what-is-true.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| ([^|]*) \|(?: [^|]*\|){3} (.+) \|$", page, re.MULTILINE)
    figures = {effect: FIGURE.findall(cell) for effect, cell in rows if FIGURE.search(cell)}
    assert figures.keys() == SOURCES.keys()
    for effect, phrases in SOURCES.items():
        for figure, phrase in zip(figures[effect], phrases, strict=True):
            assert repeats(root, figure, phrase), (effect, figure)
