import pytest

from gradysim.ladder.assertion import Assertion, Comparison, Term
from gradysim.scenario.errors import ConfigError


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("groundStation data >= 100", Comparison(Term(1, "groundStation data"), ">=", Term(100))),
        ("uavs[*] heard<-1.5e2", Comparison(Term(1, "uavs[*] heard"), "<", Term(-150))),
        ("  events ==  3 ", Comparison(Term(1, "events"), "==", Term(3))),
        (
            "base heard >= 0.95 * uavs[*] sent",
            Comparison(Term(1, "base heard"), ">=", Term(0.95, "uavs[*] sent")),
        ),
        ("100 < 2*events", Comparison(Term(100), "<", Term(2, "events"))),
    ],
)
def test_it_compares_quantities_and_numbers(text: str, expected: Comparison) -> None:
    assert Assertion.parse(text).alternatives == ((expected,),)


@pytest.mark.parametrize(
    ("relation", "holds"),
    [
        ("<", [True, False, False]),
        ("<=", [True, True, False]),
        ("==", [False, True, False]),
        ("!=", [True, False, True]),
        (">=", [False, True, True]),
        (">", [False, False, True]),
    ],
)
def test_relations(relation: str, holds: list[bool]) -> None:
    assertion = Assertion.parse(f"x {relation} 2")
    assert [assertion.holds({"x": value}) for value in (1, 2, 3)] == holds


@pytest.mark.parametrize(
    ("numbers", "holds"),
    [
        ({"heard": 95, "sent": 100, "lost": 0}, True),
        ({"heard": 94, "sent": 100, "lost": 0}, False),
        ({"heard": 95, "sent": 100, "lost": 9}, False),
        ({"heard": 94, "sent": 100, "lost": 9, "excused": 1}, True),
    ],
)
def test_and_binds_more_tightly_than_or(numbers: dict[str, float], holds: bool) -> None:
    assertion = Assertion.parse("heard >= 0.95 * sent and lost < 5 or excused > 0")
    assert assertion.quantities == ("heard", "sent", "lost", "excused")
    assert assertion.holds(numbers) == holds


@pytest.mark.parametrize(
    "text",
    ["", "data", "data >=", ">= 3", "data >= 3 and", "or data >= 3", "data >= 3 >= 2", "1 < 2", "data => 3"],
)
def test_other_texts_are_refused_with_an_example(text: str) -> None:
    with pytest.raises(ConfigError) as refused:
        Assertion.parse(text)
    assert " >= " in refused.value.expected
