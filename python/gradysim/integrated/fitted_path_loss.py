"""Path loss fitted to measurements of received power or delivery over distance, by maximum likelihood.

The model is that of `FreeSpacePathLoss` with shadowing: a power in dBm that falls with the exponent alpha of
the distance, less a constant loss, and a normally distributed deviation. For it, the line of least squares is
the most likely one. The intervals contain the values whose likelihood is at least e^-1.92 of the best one.
If there are many measurements, 95 % of the intervals contain the truth (S. S. Wilks, Annals of Mathematical
Statistics 9, 1938).

Deliveries alone leave the exponent open, so that of the scenario is kept. A frame arrives if the deviation is
below what the link has in hand, which is a probit regression on the logarithm of the distance (D. J. Finney,
Probit Analysis, 1947). The deviation includes the width of the receiver's own curve, mostly below 1 dB.
"""

import csv
import io
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.integrated.calibration import link_budget
from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.network import medium_config, node_config
from gradysim.integrated.power_for_range import MESSAGE_BYTES
from gradysim.results.durable import bytes_in
from gradysim.scenario.errors import BadValue, ConfigError
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.parse.regular_files import check_regular
from gradysim.scenario.parse.units import db_from_ratio, dbm_from_w
from gradysim.scenario.scenario import Scenario

if TYPE_CHECKING:
    from gradysim._netsim import LinkBudget

DISTANCE, POWER, DELIVERY = "distance_m", "rssi_dbm", "delivered"
"""Columns. A file has the first one, and one of the others."""

_DELIVERIES = {"0": 0.0, "no": 0.0, "1": 1.0, "yes": 1.0}

_LIKELY = 3.841458820694124
"""95 % quantile of the chi-square distribution with one degree of freedom."""

_NEAREST_M, _FARTHEST_M, _WEAKEST_DBM, _STRONGEST_DBM = 1e-9, 1e9, -300.0, 100.0
"""Bounds of what may have been measured."""

_SHOWN = 40
"""Letters of a wrong value in a message."""

_LEAST = 3
"""Measurements, at two distances or more: fewer leave no deviation. Deliveries need three distances, because
any two ratios fit a curve."""

_ANYWHERE = 200.0
"""Distance in dB over one metre, beyond all measured ones: if half may arrive only there, nothing was seen to
fall."""


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
        half_m: Distance at which half of the frames arrive, if deliveries were measured; alpha is given then.
    """

    measurements: int
    nearest_m: float
    farthest_m: float
    alpha: Fitted
    loss_db: Fitted
    deviation_db: Fitted
    half_m: Fitted | None = None


@dataclass(frozen=True)
class Measurements:
    """Lines of a file: (distance in m, value), where the value of `DELIVERY` is 0 or 1."""

    column: str
    lines: Sequence[tuple[float, float]]


def read_measurements(file: Path) -> Measurements:
    """Return the measurements of a CSV file with the columns `DISTANCE` and either `POWER` or `DELIVERY`.

    Raises ConfigError, with the file and mostly the line, for anything else, and OSError.
    """
    reader = csv.DictReader(io.StringIO(_text_in(file), newline=""))
    try:
        columns = [name for name in (POWER, DELIVERY) if name in (reader.fieldnames or ())]
        if len(columns) != 1 or DISTANCE not in (reader.fieldnames or ()):
            raise ConfigError(
                f"{file}:1: it has the columns `{','.join(reader.fieldnames or ())[:_SHOWN]}`",
                expected=f"`{DISTANCE}`, and either `{POWER}` or `{DELIVERY}`",
            )
        value_of = _power_dbm if columns[0] == POWER else _delivery
        lines = [
            (
                _distance_m(file, reader.line_num, row[DISTANCE]),
                value_of(file, reader.line_num, row[columns[0]]),
            )
            for row in reader
        ]
    except csv.Error as error:
        raise ConfigError(f"{file}:{reader.line_num + 1}: {error}", expected="a CSV file") from error
    distances = len({distance_m for distance_m, _ in lines})
    least = 2 if columns[0] == POWER else _LEAST
    if len(lines) < _LEAST or distances < least:
        raise ConfigError(
            f"{file}: {len(lines)} measurements at {distances} distances",
            expected=f"at least {_LEAST} measurements at {least} distances",
        )
    return Measurements(columns[0], lines)


def _text_in(file: Path) -> str:
    try:
        check_regular(file)
        return bytes_in(file).decode("utf-8-sig")
    except BadValue as error:
        raise ConfigError(error.problem, expected=error.expected) from None
    except UnicodeDecodeError as error:
        raise ConfigError(f"{file}: it is not UTF-8", expected="a CSV file") from error


def _distance_m(file: Path, line: int, text: str | None) -> float:
    distance_m = _number(file, line, DISTANCE, text)
    if not _NEAREST_M <= distance_m <= _FARTHEST_M:
        raise ConfigError(
            f"{file}:{line}: {DISTANCE} = {distance_m:g}", expected=f"{_NEAREST_M:g} to {_FARTHEST_M:g}"
        )
    return distance_m


def _power_dbm(file: Path, line: int, text: str | None) -> float:
    rssi_dbm = _number(file, line, POWER, text)
    if not _WEAKEST_DBM <= rssi_dbm <= _STRONGEST_DBM:
        raise ConfigError(
            f"{file}:{line}: {POWER} = {rssi_dbm:g}", expected=f"{_WEAKEST_DBM:g} to {_STRONGEST_DBM:g}"
        )
    return rssi_dbm


def _delivery(file: Path, line: int, text: str | None) -> float:
    written = (text or "").strip()
    if written.lower() not in _DELIVERIES:
        raise ConfigError(f"{file}:{line}: {DELIVERY} = `{written[:_SHOWN]}`", expected="0, 1, `no` or `yes`")
    return _DELIVERIES[written.lower()]


def _number(file: Path, line: int, name: str, text: str | None) -> float:
    try:
        return float(text or "")
    except ValueError:
        written = (text or "")[:_SHOWN]
        raise ConfigError(f"{file}:{line}: {name} = `{written}`", expected="a number") from None


def fit_path_loss(
    scenario: Scenario,
    measured: Measurements,
    sender: NodeSpec,
    receiver: NodeSpec,
    message_bytes: int = MESSAGE_BYTES,
) -> FittedPathLoss:
    """Fit path loss to measurements between two nodes, with the power and the antennas of the scenario.

    Deliveries are those of messages of that length, with the bitrate, the noise and the receiver of the
    scenario. Raises ConfigError if the scenario has no powers, or if the measured values do not fall with the
    distance.
    """
    if link_budget(scenario, sender, receiver, message_bytes).tx_power_w == 0:
        raise ConfigError("the sender has a transmit power of 0 W", expected="the power of the measurements")
    if measured.column == DELIVERY:
        return _fit_deliveries(scenario, measured.lines, sender, receiver, message_bytes)
    return _fit_powers(scenario, measured.lines, sender, receiver)


def _free_space(
    scenario: Scenario,
    sender: NodeSpec,
    receiver: NodeSpec,
    message_bytes: int,
    alpha: float,
    deviation_db: float,
) -> "LinkBudget":
    """Return the link with this path loss, and no constant loss beside it."""
    medium = medium_config(scenario)
    medium.path_loss, medium.alpha, medium.system_loss = "FreeSpacePathLoss", alpha, 1.0
    medium.shadowing_standard_deviation_db = deviation_db
    budget: LinkBudget = load_netsim().LinkBudget(
        medium, node_config(sender), node_config(receiver), message_bytes
    )
    return budget


def _fit_powers(
    scenario: Scenario, measured: Sequence[tuple[float, float]], sender: NodeSpec, receiver: NodeSpec
) -> FittedPathLoss:
    budget = _free_space(scenario, sender, receiver, 0, 2.0, 0.0)
    at_one_metre_dbm = dbm_from_w(budget.tx_power_w) + db_from_ratio(budget.mean_gain(1.0))

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
    more = rest * math.expm1(_LIKELY / count)
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

    def is_likely(log_ratio: float) -> bool:
        return 2 * count * log_ratio + count * math.expm1(-2 * log_ratio) < _LIKELY

    return best * math.exp(_end(is_likely, 0, -7)), best * math.exp(_end(is_likely, 0, 7))


def _end(is_likely: Callable[[float], bool], inside: float, outside: float) -> float:
    """Return where, between a likely value and one that is not, the interval ends."""
    for _ in range(20):  # a millionth of what is between them
        middle = (inside + outside) / 2
        inside, outside = (middle, outside) if is_likely(middle) else (inside, middle)
    return inside


def _fit_deliveries(
    scenario: Scenario,
    measured: Sequence[tuple[float, float]],
    sender: NodeSpec,
    receiver: NodeSpec,
    message_bytes: int,
) -> FittedPathLoss:
    arrived, lost = (
        [_over_one_metre_db(distance_m) for distance_m, value in measured if value == each] for each in (1, 0)
    )
    if not arrived or not lost:
        raise ConfigError(
            f"{'no' if lost else 'each'} frame arrived",
            expected="some frames that arrive and some that do not",
        )
    if max(arrived) <= min(lost):
        last_m, first_m = (f"{10 ** (each / 10):.4g} m" for each in (max(arrived), min(lost)))
        raise ConfigError(
            f"each frame up to {last_m} arrived, and none beyond: the deviation is open",
            expected=f"more frames from {last_m} to {first_m}",
        )
    if max(lost) <= min(arrived):
        raise _not_falling()
    alpha = medium_config(scenario).alpha
    probit = _Probit(measured)
    best, height, slope = probit.best(lambda x: (1.0, -x))
    half = height / slope if slope else math.inf

    def half_is_likely(half: float) -> bool:
        return 2 * (best - probit.best(lambda x: (half - x, 0.0))[0]) < _LIKELY

    def slope_is_likely(slope: float) -> bool:
        return 2 * (best - probit.best(lambda x: (1.0, 0.0), lambda x: -slope * x)[0]) < _LIKELY

    if slope <= 0 or half_is_likely(-_ANYWHERE) or half_is_likely(_ANYWHERE):
        raise _not_falling()
    steep = 2 * slope
    while slope_is_likely(steep):
        steep *= 2
    halves = Fitted(half, _end(half_is_likely, half, -_ANYWHERE), _end(half_is_likely, half, _ANYWHERE))
    slopes = _end(slope_is_likely, slope, steep), _end(slope_is_likely, slope, 0)
    deviation_db = Fitted(alpha / slope, *(alpha / each for each in slopes))
    half_m = Fitted(*(10 ** (each / 10) for each in (halves.value, halves.low, halves.high)))
    budget = _free_space(scenario, sender, receiver, message_bytes, alpha, deviation_db.value)
    in_hand_db = dbm_from_w(budget.tx_power_w) - dbm_from_w(budget.tx_power_w_for(half_m.value, 0.5))
    return FittedPathLoss(
        len(measured),
        min(distance_m for distance_m, _ in measured),
        max(distance_m for distance_m, _ in measured),
        Fitted(alpha, alpha, alpha),
        Fitted(
            in_hand_db,
            in_hand_db + alpha * (half - halves.high),
            in_hand_db + alpha * (half - halves.low),
        ),
        deviation_db,
        half_m,
    )


def _not_falling() -> ConfigError:
    return ConfigError(
        "the ratio of frames that arrived does not clearly fall with the distance",
        expected="more frames, or frames at more distances",
    )


def _over_one_metre_db(distance_m: float) -> float:
    """Round to 0.2 % of the distance, so that logs with thousands of lines are fitted in seconds."""
    return round(10 * math.log10(distance_m), 2)


class _Probit:
    """Log-likelihood of deliveries at distances x, in dB over one metre, for chances Φ(η(x))."""

    def __init__(self, measured: Sequence[tuple[float, float]]) -> None:
        counts: dict[tuple[float, float], int] = {}
        for distance_m, value in measured:
            key = (_over_one_metre_db(distance_m), 1.0 if value else -1.0)
            counts[key] = counts.get(key, 0) + 1
        self._counts = [(x, sign, count) for (x, sign), count in counts.items()]

    def best(
        self, parts: Callable[[float], tuple[float, float]], given: Callable[[float], float] = lambda _: 0.0
    ) -> tuple[float, float, float]:
        """Return the maximum over s and t with η = given(x) + s · parts(x)[0] + t · parts(x)[1], s and t.

        The log-likelihood is concave, so Newton's steps, halved where they lead down, find its maximum.
        """
        rows = [(sign, count, given(x), *parts(x)) for x, sign, count in self._counts]
        s = t = 0.0
        top = -math.inf
        step_s = step_t = 0.0
        while True:
            total = gs = gt = ss = st = tt = 0.0
            for sign, count, fixed, p, q in rows:
                log, slope, bend = _log_normal(sign * (fixed + (s + step_s) * p + (t + step_t) * q))
                total += count * log
                gs, gt = gs + count * sign * slope * p, gt + count * sign * slope * q
                ss, st, tt = ss + count * bend * p * p, st + count * bend * p * q, tt + count * bend * q * q
            if total < top:
                step_s, step_t = step_s / 2, step_t / 2
                continue
            s, t, gain, top = s + step_s, t + step_t, total - top, total
            if gain <= 1e-10:
                return top, s, t
            tt = tt or 1.0
            determinant = ss * tt - st * st
            step_s, step_t = (gs * tt - gt * st) / determinant, (gt * ss - gs * st) / determinant


def _log_normal(z: float) -> tuple[float, float, float]:
    """Return log Φ(z), its derivative, and its second derivative with the sign changed."""
    if z < -30:  # the first terms of the asymptotic series; erfc would underflow soon
        log, slope = -z * z / 2 - math.log(-z * math.sqrt(2 * math.pi)), -z - 1 / z
    else:
        phi = math.erfc(-z / math.sqrt(2)) / 2
        log, slope = math.log(phi), math.exp(-z * z / 2) / math.sqrt(2 * math.pi) / phi
    return log, slope, slope * (z + slope)
