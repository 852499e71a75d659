"""Report on autopilots after a simulation: a CSV file and a table in the log."""

import csv
import logging
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from gradysim.simulator.log import format_table

_logger = logging.getLogger(__name__)

FILE_NAME = "ardupilot_mobility_report.csv"

COLUMNS = ("node_id", "telemetry_requests", "telemetry_drops", "battery_wasted")
"""`battery_wasted` is in percent of a full battery, empty if unknown."""


@dataclass
class NodeReport:
    """Counts of one node.

    Attributes:
        requests: Number of telemetries that were due.
        drops: Number of telemetries without a position in time.
        battery_start: Percent of a full battery; None if unknown.
        battery_end: The same at the end.
        clock_error_s: Largest difference of the autopilot's clock from simulated time, < 0 if behind; s.
    """

    requests: int = 0
    drops: int = 0
    battery_start: float | None = None
    battery_end: float | None = None
    clock_error_s: float = 0.0

    @property
    def battery_wasted(self) -> float | None:
        """Battery used, in percent of a full battery."""
        if self.battery_start is None or self.battery_end is None:
            return None
        return self.battery_start - self.battery_end


def write_report(path: Path, nodes: Mapping[int, NodeReport]) -> None:
    """Write the file and log a table. If the file cannot be written, log a warning."""
    try:
        with path.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(COLUMNS)
            for identifier, node in nodes.items():
                writer.writerow((identifier, node.requests, node.drops, node.battery_wasted))
        written = f"Written to {path.absolute()}"
    except OSError as error:
        _logger.warning("The report of the autopilots cannot be written: %s", error)
        written = "Not written to a file"
    table = format_table(
        ["Node", "Telemetries", "Dropped", "Battery used (%)", "Clock off (s)"],
        [
            [
                str(identifier),
                str(node.requests),
                str(node.drops),
                "-" if node.battery_wasted is None else f"{node.battery_wasted:g}",
                f"{node.clock_error_s:+.2f}",
            ]
            for identifier, node in nodes.items()
        ],
    )
    _logger.info("Autopilots\n%s\n%s", table, written)
