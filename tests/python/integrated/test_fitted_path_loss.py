"""Path loss that is fitted to powers drawn from a known one."""

import os
import sys
from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest

from gradysim.integrated.calibration import pair_of
from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.fitted_path_loss import FittedPathLoss, fit_path_loss, read_measurements
from gradysim.integrated.network import medium_config, node_config
from gradysim.scenario import Scenario
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.units import db_from_ratio, dbm_from_w

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
        return fit_path_loss(plain, measured, *pair_of(plain, None, None))

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
        (f"distance_m,rssi_dbm\n5,{'1' * 200_000}\n", 2),
        ("distance_m,rssi_dbm\n5,-60\n5,-61\n5,-61\n", None),
        (b"distance_m,rssi_dbm\n5,\xff\n", None),
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
    assert read_measurements(file) == [(5, -60), (10, -66), (20, -72)]


def test_powers_that_grow_with_the_distance_are_refused(make_scenario: Callable[..., Scenario]) -> None:
    plain = make_scenario("class Tested(Quiet): pass", TRUTH[-1])
    with pytest.raises(ConfigError):
        fit_path_loss(plain, [(5, -80), (10, -66), (20, -62)], *pair_of(plain, None, None))


def test_extra_columns_are_left_out(tmp_path: Path) -> None:
    file = tmp_path / "powers.csv"
    file.write_text("rssi_dbm,place,distance_m\n-60,a,5\n-70,b,10\n-71,c,11\n")
    assert read_measurements(file) == [(5, -60), (10, -70), (11, -71)]
