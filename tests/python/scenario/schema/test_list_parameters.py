"""Lists and tuples as parameters of protocols."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.scenario import ConfigError, load_scenarios, parametrize

PROTOCOL = """from gradysim.protocol.interface import IProtocol
class Flyer(IProtocol):
    points: list[tuple[float, float, float]] = []
    counts: tuple[int, ...] = (1, 2)
    spans_ms = [5]
    names = ["a"]
    def initialize(self): ...
    def handle_timer(self, timer): ...
    def handle_packet(self, message): ...
"""

Value = Callable[[str, str], Any]


@pytest.fixture
def value(tmp_path: Path) -> Value:
    """`value("points", "[(0, 0)]")`: the class attribute that a protocol has with this line."""
    (tmp_path / "flyer.py").write_text(PROTOCOL)
    (tmp_path / "fly.ini").write_text(
        '[General]\nsim-time-limit = 1s\n*.numUavs = 2\n*.uavs[*].protocol.class = "flyer.py:Flyer"\n'
    )

    def of(name: str, text: str) -> Any:
        overrides = [f"*.uavs[*].protocol.{name} = {text}"]
        (scenario,) = load_scenarios(tmp_path / "fly.ini", overrides=overrides)
        spec = scenario.nodes[1]
        return getattr(parametrize(spec.protocol, spec.protocol_parameters), name)

    return of


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("points", "[(0, 0, 10), (50, 0, 10)]", [(0.0, 0.0, 10.0), (50.0, 0.0, 10.0)]),
        ("points", "[(0m, 0m, 10m), (0.05km, 0m, 10m)]", [(0.0, 0.0, 10.0), (50.0, 0.0, 10.0)]),
        ("points", "[]", []),
        ("points", "[(10m * parentIndex(), 2 * (1m + 1m), 0)]", [(10.0, 4.0, 0.0)]),
        ("counts", "(3, 4, 5)", (3, 4, 5)),
        ("counts", "(3,)", (3,)),
        ("counts", "()", ()),
        ("counts", "[3]", (3,)),
        ("spans_ms", "[1s, 20]", [1000.0, 20.0]),
        ("names", '["x, y", "(z"]', ["x, y", "(z"]),
    ],
)
def test_a_list_is_written_as_in_python_with_units(value: Value, name: str, text: str, expected: Any) -> None:
    found = value(name, text)
    assert found == expected
    assert repr(found) == repr(expected)


@pytest.mark.parametrize("text", ["5", "[1, 2", "[1 2]", "[1] + [2]", "[(1, 2)", "[1,,2]"])
def test_anything_else_is_a_mistake_of_the_line(value: Value, text: str) -> None:
    with pytest.raises(ConfigError) as mistake:
        value("points", text)
    assert mistake.value.expected == "a list such as [1, 2]"


def test_equal_numbers_of_other_types_are_other_values(value: Value) -> None:
    assert repr(value("counts", "(1, 2)")) == "(1, 2)"
    assert repr(value("counts", "(1.0, 2)")) == "(1.0, 2)"
