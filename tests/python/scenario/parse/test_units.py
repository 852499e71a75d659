import math
import re
from collections.abc import Callable
from contextlib import suppress
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.errors import BadValue
from gradysim.scenario.parse.expressions import parse_value
from gradysim.scenario.parse.units import (
    UNITS,
    Dimension,
    Quantity,
    Unit,
    db_from_ratio,
    dbm_from_w,
    ratio_from_db,
    unit_named,
)


@pytest.mark.parametrize(
    ("name", "dimension", "factor"),
    [
        ("d", Dimension.TIME, 86400),
        ("m", Dimension.LENGTH, 1),
        ("min", Dimension.TIME, 60),
        ("B", Dimension.DATA, 8),
        ("kB", Dimension.DATA, 8000),
        ("KiB", Dimension.DATA, 8192),
        ("mps", Dimension.SPEED, 1),
        ("kmph", Dimension.SPEED, Fraction(1000, 3600)),
        ("mW", Dimension.POWER, Fraction(1, 1000)),
        ("MW", Dimension.POWER, 1000000),
        ("h", Dimension.TIME, 3600),
        ("Bps", Dimension.BITRATE, 8),
        ("Wh", Dimension.ENERGY, 3600),
        ("x", Dimension.RATIO, 1),
    ],
)
def test_means_what_omnetpp_means(name: str, dimension: Dimension, factor: Fraction) -> None:
    unit = unit_named(name)
    assert (unit.dimension, unit.factor, unit.logarithmic) == (dimension, factor, False)


DECIMAL = {"a": -18, "f": -15, "p": -12, "n": -9, "u": -6, "m": -3, "c": -2, "k": 3, "M": 6, "G": 9, "T": 12}
BINARY = {"Ki": 10, "Mi": 20, "Gi": 30}
PREFIXES = {
    **{prefix: Fraction(10) ** exponent for prefix, exponent in DECIMAL.items()},
    **{prefix: Fraction(2) ** exponent for prefix, exponent in BINARY.items()},
}


def test_prefixes_mean_the_same_in_front_of_every_unit() -> None:
    compared = 0
    for name, unit in UNITS.items():
        for prefix, factor in PREFIXES.items():
            base = UNITS.get(name.removeprefix(prefix))
            if base is not None and base is not unit and base.dimension is unit.dimension:
                assert unit.factor == factor * base.factor, name
                compared += 1
    assert compared > 50


def test_decibels_alone_are_a_dimension_of_their_own() -> None:
    assert unit_named("dB").dimension is Dimension.LEVEL
    assert {name for name, unit in UNITS.items() if unit.logarithmic} == {
        "dBm",
        "dBmW",
        "dBW",
    }


def test_every_dimension_has_a_linear_si_unit() -> None:
    for dimension in Dimension:
        assert any(u.factor == 1 and not u.logarithmic for u in UNITS.values() if u.dimension is dimension)


def test_an_unknown_unit_names_the_nearest() -> None:
    with pytest.raises(BadValue) as error:
        unit_named("mpss")
    assert error.value.suggestion == "mps"


@pytest.mark.parametrize(("ratio", "ratio_db"), [(1, 0), (10, 10), (0.01, -20)])
def test_tenfold_is_10_db(ratio: float, ratio_db: float) -> None:
    assert (db_from_ratio(ratio), ratio_from_db(ratio_db)) == (ratio_db, ratio)


def test_1_mw_is_0_dbm() -> None:
    assert (dbm_from_w(1e-3), dbm_from_w(1)) == (0, 30)


def test_nothing_is_minus_infinity() -> None:
    assert (db_from_ratio(0), dbm_from_w(0)) == (-math.inf, -math.inf)


@given(st.floats(-300, 300))
def test_there_and_back(ratio_db: float) -> None:
    assert db_from_ratio(ratio_from_db(ratio_db)) == pytest.approx(ratio_db, abs=1e-12)


linear_units = st.sampled_from([unit for unit in UNITS.values() if not unit.logarithmic])
powers = st.sampled_from([unit for unit in UNITS.values() if unit.dimension is Dimension.POWER])
levels = powers.filter(lambda unit: unit.logarithmic)
finite = st.floats(allow_nan=False, allow_infinity=False)


def q(number: float, unit: str | None = None) -> Quantity:
    exact = number if isinstance(number, int) or not math.isfinite(number) else Fraction(number)
    return Quantity(exact, UNITS[unit] if unit else None)


@pytest.mark.parametrize(
    ("quantity", "unit", "expected"),
    [
        (q(100, "ms"), "s", 0.1),
        (q(2, "h"), "s", 7200.0),
        (q(36, "kmph"), "mps", 10.0),
        (q(2304, "B"), "b", 18432.0),
        (q(2304, "b"), "B", 288.0),
        (q(45, "deg"), "deg", 45.0),
        (q(180, "deg"), "rad", math.pi),
        (q(4, "dB"), "dB", 4.0),
        (q(math.inf, "ms"), "s", math.inf),
    ],
)
def test_converts(quantity: Quantity, unit: str, expected: float) -> None:
    assert quantity.to(UNITS[unit]) == expected


@pytest.mark.parametrize(
    ("quantity", "watts"),
    [
        (q(0, "dBm"), 1e-3),
        (q(-110, "dBm"), 1e-14),
        (q(-85, "dBm"), 3.1622776601683794e-12),
        (q(20, "dBmW"), 0.1),
        (q(3, "dBW"), 1.9952623149688795),
    ],
)
def test_levels_become_powers(quantity: Quantity, watts: float) -> None:
    assert quantity.to(UNITS["W"]) == pytest.approx(watts, rel=1e-15)


@pytest.mark.parametrize(
    ("quantity", "unit", "level"),
    [
        (q(100, "mW"), "dBm", 20.0),
        (q(0.5, "W"), "dBW", -3.010299956639812),
        (q(math.inf, "W"), "dBm", math.inf),
        (q(20, "dBm"), "dBm", 20.0),
        (q(20, "dBm"), "dBmW", 20.0),
        (q(20, "dBm"), "dBW", -10.0),
        (q(-3, "dBW"), "dBm", 27.0),
    ],
)
def test_powers_become_levels(quantity: Quantity, unit: str, level: float) -> None:
    assert quantity.to(UNITS[unit]) == pytest.approx(level, rel=1e-15)


@given(st.floats(1e-30, 1e30), powers, levels)
def test_a_power_is_the_same_one_after_a_level(number: float, power: Unit, level: Unit) -> None:
    quantity = Quantity(Fraction(number), power)
    again = Quantity(Fraction(quantity.to(level)), level).to(power)
    assert again == pytest.approx(number, rel=1e-12)


@pytest.mark.parametrize("number", [0, -1, Fraction(1, 10**400)])
def test_what_has_no_logarithm_is_refused(number: int | Fraction) -> None:
    with pytest.raises(BadValue):
        Quantity(number, UNITS["W"]).to(UNITS["dBm"])


@given(finite, linear_units)
def test_to_its_own_unit_and_back_changes_nothing(number: float, unit: object) -> None:
    quantity = Quantity(Fraction(number), unit)  # type: ignore[arg-type]
    assert quantity.to(unit) == number  # type: ignore[arg-type]


@given(st.integers(-(10**6), 10**6), linear_units, st.data())
def test_a_conversion_is_rounded_once(number: int, unit: object, data: st.DataObject) -> None:
    same = [other for other in UNITS.values() if other.dimension is unit.dimension and not other.logarithmic]  # type: ignore[attr-defined]
    other = data.draw(st.sampled_from(same))
    assert Quantity(number, unit).to(other) == float(number * unit.factor / other.factor)  # type: ignore[arg-type,attr-defined]


@given(
    st.one_of(st.integers(-(10**15), 10**15), finite),
    st.sampled_from([None, *UNITS.values()]),
)
def test_its_text_reads_as_itself(number: float, unit: object) -> None:
    quantity = Quantity(number if isinstance(number, int) else Fraction(number), unit)  # type: ignore[arg-type]
    again = parse_value(str(quantity))
    assert isinstance(again, Quantity)
    assert (float(again.number), again.unit) == (float(number), unit)
    assert isinstance(again.number, int) is isinstance(number, int)


@pytest.mark.parametrize(
    ("quantity", "unit", "message"),
    [
        (q(3), "s", "`3` has no unit"),
        (q(3, "m"), "mps", "`m` is the unit of a length"),
        (
            q(5, "m"),
            "s",
            "`m` is the unit of a length; `m` is meters, a minute is `min`",
        ),
        (q(4, "dB"), "W", "`dB` is the unit of a ratio in decibels"),
        (q(9999, "dBm"), "W", "`9999dBm` is too large for a number"),
    ],
)
def test_wrong_dimensions_are_errors(quantity: Quantity, unit: str, message: str) -> None:
    with pytest.raises(BadValue, match=f"^{re.escape(message)}$"):
        quantity.to(UNITS[unit])


ROUNDED = Quantity(math.sqrt(2), UNITS["as"])


@pytest.mark.parametrize(
    ("operation", "message"),
    [
        (lambda: q(1, "W").numbers_beside(q(4000, "dBm")), "`4000dBm` is too large for a number"),
        (lambda: q(1, "fW").numbers_beside(q(3080, "dBm")), "`3080dBm` is too large for a number"),
        (lambda: q(1, "dBm").numbers_beside(q(1e308, "GW")), "`1e+308GW` is too large for a number"),
        (lambda: ROUNDED.numbers_beside(q(1e308, "d")), "`1e+308d` is too large for a number"),
        (lambda: ROUNDED.plus(q(1e308, "d")), "`1e+308d` is too large for a number"),
        (lambda: ROUNDED.over(q(1e308, "d")), "`1e+308d` is too large for a number"),
        (lambda: ROUNDED.over(Quantity(Fraction(1, 10**400))), f"`{ROUNDED}` is divided by zero"),
    ],
)
def test_what_only_a_rounded_number_would_need_is_told(operation: Callable[[], object], message: str) -> None:
    with pytest.raises(BadValue, match=f"^{re.escape(message)}$"):
        operation()


def test_exact_numbers_are_compared_and_divided_however_large() -> None:
    here, there = q(1, "as").numbers_beside(q(1e308, "d"))
    assert here < there
    assert q(1, "as").over(q(1e308, "d")).number == 1 / (Fraction(1e308) * 86400 * 10**18)


any_number = st.one_of(st.integers(-5000, 5000), finite.map(Fraction), st.floats())
quantities = st.builds(Quantity, any_number, st.sampled_from([None, *UNITS.values()]))


@given(
    quantities, quantities, st.sampled_from(["numbers_beside", "plus", "times", "over", "modulo", "power"])
)
def test_whatever_has_no_value_is_told(one: Quantity, other: Quantity, operation: str) -> None:
    with suppress(BadValue):
        getattr(one, operation)(other)


def test_every_dimension_has_a_name_for_messages() -> None:
    assert len({dimension.value for dimension in Dimension}) == len(Dimension)
