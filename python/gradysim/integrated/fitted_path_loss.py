"""Path loss fitted to measurements of received power over distance, by maximum likelihood.

The model is that of `FreeSpacePathLoss` with shadowing: a power in dBm that falls with the exponent alpha of
the distance, less a constant loss, and a normally distributed deviation. For it, the line of least squares is
the most likely one. The intervals contain the values whose likelihood is at least e^-1.92 of the best one.
If there are many measurements, 95 % of the intervals contain the truth (S. S. Wilks, Annals of Mathematical
Statistics 9, 1938).
"""

import csv
import io
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from gradysim.integrated.calibration import link_budget
from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.network import medium_config, node_config
from gradysim.results.durable import bytes_in
from gradysim.scenario.errors import BadValue, ConfigError
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.regular_files import check_regular
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.units import db_from_ratio, dbm_from_w

COLUMNS = ("distance_m", "rssi_dbm")

_LIKELIHOOD = math.exp(3.841458820694124)
"""e to the 95 % quantile of the chi-square distribution with one degree of freedom."""

_FARTHEST_M, _WEAKEST_DBM, _STRONGEST_DBM = 1e9, -300.0, 100.0
"""Bounds of what may have been measured."""

_SHOWN = 40
"""Letters of a wrong value in a message."""

_LEAST = 3
"""Measurements, at two distances or more: fewer leave no deviation."""


@dataclass(frozen=True)
class Fitted:
    """A value with its interval of 95 %."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class FittedPathLoss:
    """What measurements say about path loss.

    Attributes:
        measurements: Their number.
        nearest_m: Smallest distance.
        farthest_m: Largest distance.
        alpha: Exponent of the distance.
        loss_db: What is missing beside it, at all distances, with the powers and antennas of the scenario.
        deviation_db: Standard deviation from the line.
    """

    measurements: int
    nearest_m: float
    farthest_m: float
    alpha: Fitted
    loss_db: Fitted
    deviation_db: Fitted


def read_measurements(file: Path) -> list[tuple[float, float]]:
    """Return (distance in m, received power in dBm) of each line of a CSV file with these columns.

    Raises ConfigError, with the file and mostly the line, for anything else, and OSError.
    """
    reader = csv.DictReader(io.StringIO(_text_in(file), newline=""))
    try:
        missing = [name for name in COLUMNS if name not in (reader.fieldnames or ())]
        if missing:
            raise ConfigError(f"{file}:1: no column `{missing[0]}`", expected=f"`{','.join(COLUMNS)}`")
        found = [_measurement(file, reader.line_num, row) for row in reader]
    except csv.Error as error:
        raise ConfigError(f"{file}:{reader.line_num + 1}: {error}", expected="a CSV file") from error
    if len(found) < _LEAST or len({distance_m for distance_m, _ in found}) == 1:
        raise ConfigError(
            f"{file}: {len(found)} measurements at {len({distance_m for distance_m, _ in found})} distances",
            expected=f"at least {_LEAST} measurements at 2 distances",
        )
    return found


def _text_in(file: Path) -> str:
    try:
        check_regular(file)
        return bytes_in(file).decode("utf-8-sig")
    except BadValue as error:
        raise ConfigError(error.problem, expected=error.expected) from None
    except UnicodeDecodeError as error:
        raise ConfigError(f"{file}: it is not UTF-8", expected="a CSV file") from error


def _measurement(file: Path, line: int, row: dict[str, str | None]) -> tuple[float, float]:
    distance_m, rssi_dbm = (_number(file, line, name, row[name]) for name in COLUMNS)
    if not 0 < distance_m <= _FARTHEST_M:
        raise ConfigError(
            f"{file}:{line}: distance_m = {distance_m:g}", expected=f"more than 0, at most {_FARTHEST_M:g}"
        )
    if not _WEAKEST_DBM <= rssi_dbm <= _STRONGEST_DBM:
        raise ConfigError(
            f"{file}:{line}: rssi_dbm = {rssi_dbm:g}", expected=f"{_WEAKEST_DBM:g} to {_STRONGEST_DBM:g}"
        )
    return distance_m, rssi_dbm


def _number(file: Path, line: int, name: str, text: str | None) -> float:
    try:
        return float(text or "")
    except ValueError:
        written = (text or "")[:_SHOWN]
        raise ConfigError(f"{file}:{line}: {name} = `{written}`", expected="a number") from None


def fit_path_loss(
    scenario: Scenario, measured: Sequence[tuple[float, float]], sender: NodeSpec, receiver: NodeSpec
) -> FittedPathLoss:
    """Fit path loss to measurements between two nodes, with the power and the antennas of the scenario.

    `measured` is as `read_measurements` returns it. Raises ConfigError if the scenario has no powers, or if
    the measured ones do not fall with the distance.
    """
    link_budget(scenario, sender, receiver, 0)  # it has powers, and they are valid
    medium = medium_config(scenario)
    medium.path_loss, medium.alpha, medium.system_loss = "FreeSpacePathLoss", 2.0, 1.0
    medium.shadowing_standard_deviation_db = 0.0
    budget = load_netsim().LinkBudget(medium, node_config(sender), node_config(receiver), 0)
    power_w = node_config(sender).wlan[0].radio.tx_power_w
    at_one_metre_dbm = dbm_from_w(power_w) + db_from_ratio(budget.mean_gain(1.0))

    count = len(measured)
    tenths = [10 * math.log10(distance_m) for distance_m, _ in measured]
    losses = [at_one_metre_dbm - rssi_dbm for _, rssi_dbm in measured]
    mean_x, mean_y = math.fsum(tenths) / count, math.fsum(losses) / count
    spread = math.fsum((x - mean_x) ** 2 for x in tenths)
    alpha = math.fsum((x - mean_x) * (y - mean_y) for x, y in zip(tenths, losses, strict=True)) / spread
    if alpha <= 0:
        raise ConfigError("the measured powers do not fall with the distance", expected="powers that do")
    loss_db = mean_y - alpha * mean_x
    rest = math.fsum((y - loss_db - alpha * x) ** 2 for x, y in zip(tenths, losses, strict=True))
    # The likelihood of another alpha or loss, with the others at their best, falls with the sum of squares.
    more = rest * (_LIKELIHOOD ** (1 / count) - 1)
    alpha_off = math.sqrt(more / spread)
    loss_off = math.sqrt(more * (1 / count + mean_x**2 / spread))
    deviation_db = math.sqrt(rest / count)
    return FittedPathLoss(
        count,
        min(distance_m for distance_m, _ in measured),
        max(distance_m for distance_m, _ in measured),
        Fitted(alpha, alpha - alpha_off, alpha + alpha_off),
        Fitted(loss_db, loss_db - loss_off, loss_db + loss_off),
        Fitted(deviation_db, *_deviations(deviation_db, count)),
    )


def _deviations(best: float, count: int) -> tuple[float, float]:
    """Return the ends of the interval of a standard deviation."""

    def is_likely(ratio: float) -> bool:
        return 2 * count * math.log(ratio) + count * (1 / ratio**2 - 1) < math.log(_LIKELIHOOD)

    return best * _end(is_likely, 1e-3), best * _end(is_likely, 1e3)


def _end(is_likely: Callable[[float], bool], outside: float) -> float:
    """Return where, between 1 and `outside`, the ratios end that are likely."""
    inside = 1.0
    for _ in range(60):
        middle = math.sqrt(inside * outside)
        inside, outside = (middle, outside) if is_likely(middle) else (inside, middle)
    return inside
