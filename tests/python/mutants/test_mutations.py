"""Mutations change what runs, and leave a valid file."""

import ast
from pathlib import Path

import pytest

from python.mutants.mutations import mutations

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("x = a < b", {"x = a <= b"}),
        ("x = (a) in (b)", {"x = (a) not in (b)"}),
        ("x = a and b", {"x = a or b"}),
        ("x = a + 1", {"x = a - 1", "x = a + 2"}),
        ("x = not a", {"x = bool(a)"}),
        ("x = True", {"x = False"}),
        ("x = 1 if a else b", {"x = 2 if a else b", "x = 1 if (not (a)) else b"}),
        ("f(a)", {"pass"}),
        ("def f() -> int: return g", {"def f() -> int: return None"}),
        ('x: "Final[1]" = "text"', set()),
        ("if TYPE_CHECKING:\n    import a", set()),
    ],
)
def test_each_part_that_runs_is_changed(source: str, expected: set[str]) -> None:
    changed = [mutation.applied(source.encode()).decode() for mutation in mutations(source.encode())]
    assert {" ".join(text.split()) for text in changed} == expected


def test_mutants_of_the_package_are_valid_and_different() -> None:
    for file in sorted((ROOT / "python/gradysim/scenario").glob("*.py")):
        source = file.read_bytes()
        for mutation in mutations(source):
            changed = mutation.applied(source)
            ast.parse(changed)
            assert changed != source, (file, mutation)
