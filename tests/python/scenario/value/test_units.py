from fractions import Fraction

import pytest

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.units import UNITS, Dimension, unit_named


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
    with pytest.raises(BadValue, match=r"^there is no unit `mpss`; did you mean `mps`\?$"):
        unit_named("mpss")
