from pathlib import Path

import pytest

from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.errors.source import Source
from gradysim.scenario.file.reader import Entry
from gradysim.scenario.sweep import Constraint

VALUES = {"x": "3", "y": "4", "t": "10ms", "p": "-80dBm", "name": '"a"', "0": "7"}


def entry(text: str) -> Entry:
    return Entry("constraint", text, Source(Path("a.ini"), 7, "constraint", text), "General")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("$x < $y", True),
        ("$x > $y", False),
        ("$x <= 3", True),
        ("$x >= 3.5", False),
        ("${x} * ${ y } == 12", True),
        ("$x != $y", True),
        ("$t < 1s", True),
        ("$t == 0.01s", True),
        ("$p < -70dBm", True),
        ('$name == "a"', True),
        ('$name != "(a"', True),
        ("($x + 1) * 2 == 8", True),
        ("$0 == 7", True),
        ("$x > $y || $t < 1s", True),
        ("$x < $y && $t > 1s", False),
        ("$x == 3 || $x == 4 && $y == 5", True),
        ('"$x < $y"', True),
        ('""', True),
        ("($x < 3 || $y > 3) && !($x == $y)", True),
        ("$x % 2 == 0", False),
        ('$name =~ "b*"', False),
        ('"a" == "b"', False),
    ],
)
def test_constraints(text: str, expected: bool) -> None:
    assert Constraint(entry(text)).holds(VALUES) is expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("$z < 3", "there is no variable `z`; expected `$x` or `$y`"),
        ("$x", "`3` is neither true nor false in `3`; expected comparisons such as `$x < $y && $y != 3`"),
        ("1 < $x < 5", "`true` and `5` cannot be compared in `1 < 3 < 5`"),
        ("1 < $x < 5", "; several comparisons are joined by `&&`"),
        ("$x < $t", "`3` and `10ms` measure different things and cannot be compared in `3 < 10ms`"),
        ("$x < 10mW", "measure different things"),
        ("$t < 10mW", "measure different things"),
        ("$x = 3", "`=` is not understood there in `3 = 3`; expected comparisons such as `$x < $y &&"),
        ("$x = 3", "; did you mean `==`?"),
        ("$x > 1 and $y > 1", "; did you mean `&&`?"),
        ("$x > 1 or $y > 1", "; did you mean `||`?"),
        ("$x > 1 &&", "the value ends too early in `3 > 1 &&`"),
        ("($x > 1", "`(` is not closed"),
        ("$x == $name", '`3` and `"a"` cannot be compared'),
    ],
)
def test_mistakes(text: str, message: str) -> None:
    with pytest.raises(ConfigError) as caught:
        Constraint(entry(text)).holds(VALUES)
    assert str(caught.value).startswith(f"a.ini:7: constraint = {text}: ")
    assert message in str(caught.value)
