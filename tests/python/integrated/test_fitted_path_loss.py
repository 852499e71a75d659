"""Path loss that is fitted to powers and deliveries drawn from a known one."""

import os
import sys
from collections.abc import Callable
from dataclasses import astuple, replace
from pathlib import Path
from random import Random

import pytest

from gradysim.integrated.calibration import pair_of
from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.fitted_path_loss import (
    DELIVERY,
    POWER,
    Fitted,
    FittedPathLoss,
    Measurements,
    fit_path_loss,
    read_measurements,
)
from gradysim.integrated.network import medium_config, node_config
from gradysim.scenario import Scenario
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.parse.units import db_from_ratio, dbm_from_w

ALPHA, LOSS_DB, DEVIATION_DB = 2.4, 6.0, 4.0
TRUTH = [
    "*.radioMedium.pathLoss.alpha = 2.4",
    "*.radioMedium.pathLoss.systemLoss = 6dB",
    "**.wlan[*].radio.transmitter.power = 50mW",
]


@pytest.fixture
def fit(make_scenario: Callable[..., Scenario]) -> Callable[[int, int], FittedPathLoss]:
    """`fit(seed, count)`: what is fitted to that many powers, drawn with the engine's own path loss."""
    true = make_scenario("class Tested(Quiet): pass", *TRUTH)
    plain = make_scenario("class Tested(Quiet): pass", TRUTH[-1])
    node = node_config(true.nodes[0])
    budget = load_netsim().LinkBudget(medium_config(true), node, node, 0)
    power_dbm = dbm_from_w(node.wlan[0].radio.tx_power_w)

    def fitted(seed: int, count: int) -> FittedPathLoss:
        random = Random(seed)
        distances = [random.uniform(5, 100) for _ in range(count)]
        measured = [
            (each, power_dbm + db_from_ratio(budget.mean_gain(each)) + random.gauss(0, DEVIATION_DB))
            for each in distances
        ]
        return fit_path_loss(plain, Measurements(POWER, measured), *pair_of(plain, None, None))

    return fitted


@pytest.fixture
def fit_delivered(make_scenario: Callable[..., Scenario]) -> Callable[[int, int], FittedPathLoss]:
    """`fit_delivered(seed, count)`: the same for deliveries, drawn with the engine's own receiver."""
    true = make_scenario("class Tested(Quiet): pass", *TRUTH)
    plain = make_scenario("class Tested(Quiet): pass", TRUTH[0], TRUTH[2])
    node = node_config(true.nodes[0])
    budget = load_netsim().LinkBudget(medium_config(true), node, node, 50)
    power_w = node.wlan[0].radio.tx_power_w
    half_m = 10 ** (db_from_ratio(power_w / budget.tx_power_w_for(1.0, 0.5)) / 10 / ALPHA)

    def fitted(seed: int, count: int) -> FittedPathLoss:
        random = Random(seed)
        measured = []
        for _ in range(count):
            distance_m = half_m * random.choice((0.5, 0.7, 0.85, 1, 1.2, 1.4, 2))
            lucky_w = power_w * 10 ** (random.gauss(0, DEVIATION_DB) / 10)
            measured.append(
                (distance_m, float(random.random() < budget.reception_ratio(distance_m, lucky_w)))
            )
        found = fit_path_loss(plain, Measurements(DELIVERY, measured), *pair_of(plain, None, None))
        assert found.half_m is not None
        return replace(found, half_m=Fitted(*(each / half_m for each in astuple(found.half_m))))

    return fitted


def test_it_finds_what_the_engine_has(fit: Callable[[int, int], FittedPathLoss]) -> None:
    found = fit(1, 20_000)
    assert found.alpha.value == pytest.approx(ALPHA, abs=0.05)
    assert found.loss_db.value == pytest.approx(LOSS_DB, abs=0.8)
    assert found.deviation_db.value == pytest.approx(DEVIATION_DB, rel=0.02)


@pytest.mark.parametrize(("count", "share"), [(8, 0.9), (100, 0.95)])
def test_its_intervals_contain_the_truth(
    fit: Callable[[int, int], FittedPathLoss], count: int, share: float
) -> None:
    found = [fit(seed, count) for seed in range(400)]
    truths = [("alpha", ALPHA), ("loss_db", LOSS_DB), ("deviation_db", DEVIATION_DB)]
    for name, truth in truths:
        inside = [getattr(each, name).low <= truth <= getattr(each, name).high for each in found]
        assert sum(inside) / len(inside) == pytest.approx(share, abs=0.03)


def test_it_finds_what_the_engine_has_from_deliveries(
    fit_delivered: Callable[[int, int], FittedPathLoss],
) -> None:
    found = fit_delivered(1, 40_000)
    assert found.alpha == Fitted(ALPHA, ALPHA, ALPHA)
    assert found.loss_db.value == pytest.approx(LOSS_DB, abs=0.15)
    assert found.deviation_db.value == pytest.approx(DEVIATION_DB, rel=0.04)
    assert found.half_m is not None
    assert found.half_m.value == pytest.approx(1, rel=0.02)


@pytest.mark.parametrize("count", [100, 300])
def test_its_intervals_contain_the_truth_of_deliveries(
    fit_delivered: Callable[[int, int], FittedPathLoss], count: int
) -> None:
    found = [fit_delivered(seed, count) for seed in range(200)]
    for name, truth in (("half_m", 1), ("loss_db", LOSS_DB), ("deviation_db", DEVIATION_DB)):
        inside = [getattr(each, name).low <= truth <= getattr(each, name).high for each in found]
        assert sum(inside) / len(inside) == pytest.approx(0.95, abs=0.03)


@pytest.mark.parametrize(
    ("deliveries", "expected"),
    [
        ({5: "111", 10: "111", 20: "111"}, "some"),
        ({5: "000", 10: "000", 20: "000"}, "some"),
        ({5: "111", 10: "101", 20: "000"}, "10 m to 10 m"),
        ({5: "111", 10: "111", 20: "000"}, "10 m to 20 m"),
        ({5: "111", 10: "111", 10.0001: "000", 10.0002: "111"}, "10 m to 10 m"),
        ({10: "101", 10.0001: "010", 10.0002: "101"}, "10 m to 10 m"),
        ({5: "000", 10: "000", 20: "111"}, "more distances"),
        ({5: "000", 10: "010", 20: "111"}, "more distances"),
        ({5: "101", 10: "010", 20: "101"}, "more distances"),
    ],
)
def test_deliveries_that_leave_something_open_are_refused(
    make_scenario: Callable[..., Scenario], deliveries: dict[float, str], expected: str
) -> None:
    plain = make_scenario("class Tested(Quiet): pass", TRUTH[-1])
    lines = [(distance_m, float(each)) for distance_m, frames in deliveries.items() for each in frames]
    with pytest.raises(ConfigError) as error:
        fit_path_loss(plain, Measurements(DELIVERY, lines), *pair_of(plain, None, None))
    assert expected in error.value.expected


@pytest.mark.parametrize("column", [POWER, DELIVERY])
def test_a_sender_without_power_is_refused(make_scenario: Callable[..., Scenario], column: str) -> None:
    silent = make_scenario("class Tested(Quiet): pass", "**.transmitter.power = 0W")
    lines = [(1.0, 1.0), (2.0, 0.0), (3.0, 1.0), (4.0, 0.0)]
    with pytest.raises(ConfigError) as error:
        fit_path_loss(silent, Measurements(column, lines), *pair_of(silent, None, None))
    assert "power" in error.value.expected


@pytest.mark.parametrize("ratio", [1e-3, 0.5, 1e3])
def test_fits_of_deliveries_scale_with_the_distance(
    make_scenario: Callable[..., Scenario], ratio: float
) -> None:
    plain = make_scenario("class Tested(Quiet): pass", TRUTH[-1])
    pair = pair_of(plain, None, None)
    lines = [(d, float(each)) for d, frames in ((1, "11111"), (2, "10110"), (4, "00100")) for each in frames]
    near = fit_path_loss(plain, Measurements(DELIVERY, lines), *pair)
    far = fit_path_loss(plain, Measurements(DELIVERY, [(ratio * d, each) for d, each in lines]), *pair)
    assert near.half_m is not None
    assert far.half_m is not None
    assert astuple(far.half_m) == pytest.approx([ratio * each for each in astuple(near.half_m)], rel=1e-4)
    assert astuple(far.deviation_db) == pytest.approx(astuple(near.deviation_db), rel=1e-4)


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("distance,rssi_dbm\n1,2\n", 1),
        ("", 1),
        ("distance_m,rssi_dbm\n5,-60\n-5,-60\n", 3),
        ("distance_m,rssi_dbm\n5\n", 2),
        ("distance_m,rssi_dbm\n5,nan\n", 2),
        ("distance_m,rssi_dbm\n5,strong\n", 2),
        ("distance_m,rssi_dbm\n5,1e308\n", 2),
        ("distance_m,rssi_dbm\n1e300,-60\n", 2),
        ("distance_m,rssi_dbm\n1e-300,-60\n", 2),
        (f"distance_m,rssi_dbm\n5,{'1' * 200_000}\n", 2),
        ("distance_m,rssi_dbm\n5,-60\n5,-61\n5,-61\n", None),
        (b"distance_m,rssi_dbm\n5,\xff\n", None),
        ("distance_m,rssi_dbm,delivered\n5,-60,1\n", 1),
        ("distance_m,delivered\n5,2\n", 2),
        ("distance_m,delivered\n5,\n", 2),
        ("distance_m,delivered\n5\n", 2),
        (f"distance_m,delivered\n5,{'y' * 1000}\n", 2),
        ("distance_m,delivered\nnan,1\n", 2),
        ("distance_m,delivered\n5,1\n9,1\n9,0\n9,1\n", None),
    ],
)
def test_what_is_no_measurement_is_told_with_its_line(
    tmp_path: Path, text: str | bytes, line: int | None
) -> None:
    file = tmp_path / "powers.csv"
    file.write_bytes(text.encode() if isinstance(text, str) else text)
    with pytest.raises(ConfigError) as error:
        read_measurements(file)
    assert len(str(error.value)) < 300
    place = f"{file}:{line}: " if line else f"{file}: "
    assert str(error.value).startswith(place)


@pytest.mark.skipif(sys.platform == "win32", reason="it has no named pipes")
def test_a_pipe_is_refused(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "powers.csv")
    with pytest.raises(ConfigError):
        read_measurements(tmp_path / "powers.csv")


def test_spreadsheets_begin_with_a_mark_of_the_encoding(tmp_path: Path) -> None:
    file = tmp_path / "powers.csv"
    file.write_text("\ufeffdistance_m,rssi_dbm\r\n5,-60\r\n10,-66\r\n20,-72\r\n", newline="")
    assert read_measurements(file) == Measurements(POWER, [(5, -60), (10, -66), (20, -72)])


def test_deliveries_are_numbers_or_words(tmp_path: Path) -> None:
    file = tmp_path / "frames.csv"
    file.write_text("distance_m,delivered\n5,1\n10,Yes\n20,0\n40, no\n")
    assert read_measurements(file) == Measurements(DELIVERY, [(5, 1), (10, 1), (20, 0), (40, 0)])


def test_powers_that_grow_with_the_distance_are_refused(make_scenario: Callable[..., Scenario]) -> None:
    plain = make_scenario("class Tested(Quiet): pass", TRUTH[-1])
    rising = Measurements(POWER, [(5, -80), (10, -66), (20, -62)])
    with pytest.raises(ConfigError):
        fit_path_loss(plain, rising, *pair_of(plain, None, None))


def test_extra_columns_are_left_out(tmp_path: Path) -> None:
    file = tmp_path / "powers.csv"
    file.write_text("rssi_dbm,place,distance_m\n-60,a,5\n-70,b,10\n-71,c,11\n")
    assert read_measurements(file) == Measurements(POWER, [(5, -60), (10, -70), (11, -71)])
