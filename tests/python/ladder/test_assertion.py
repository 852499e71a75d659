import pytest

from gradysim.ladder.assertion import Assertion
from gradysim.scenario.errors import ConfigError


@pytest.mark.parametrize(
    ("text", "metric", "relation", "bound"),
    [
        ("groundStation data >= 100", "groundStation data", ">=", 100),
        ("uavs[*] heard<5", "uavs[*] heard", "<", 5),
        ("  unicast messages delay in s <= 1e-3 ", "unicast messages delay in s", "<=", 0.001),
        ("base change != -0.5", "base change", "!=", -0.5),
        ("base change == .5", "base change", "==", 0.5),
        ("base change > +2", "base change", ">", 2),
    ],
)
def test_a_quantity_a_relation_and_a_number(text: str, metric: str, relation: str, bound: float) -> None:
    assert Assertion.parse(text) == Assertion(metric, relation, bound)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "heard",
        "heard >=",
        ">= 5",
        "heard => 5",
        "heard = 5",
        "heard >= many",
        "heard >= 1 2",
        "a < b < 3",
    ],
)
def test_anything_else_is_refused_with_an_example(text: str) -> None:
    with pytest.raises(ConfigError, match="is not an assertion; expected QUANTITY >= NUMBER"):
        Assertion.parse(text)


@pytest.mark.parametrize(
    ("relation", "holds"),
    [
        ("<", (True, False, False)),
        ("<=", (True, True, False)),
        (">", (False, False, True)),
        (">=", (False, True, True)),
        ("==", (False, True, False)),
        ("!=", (True, False, True)),
    ],
)
def test_a_value_is_compared_with_the_bound(relation: str, holds: tuple[bool, ...]) -> None:
    assertion = Assertion.parse(f"base heard {relation} 2")
    assert tuple(assertion.holds(value) for value in (1, 2, 3)) == holds
