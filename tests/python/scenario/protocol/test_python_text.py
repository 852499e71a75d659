import ast
import warnings

import pytest

from gradysim.scenario.protocol.python_text import parsed_python


@pytest.mark.parametrize("action", ["error", "always"])
def test_it_says_nothing_of_doubtful_text(action: str) -> None:
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter(action)  # type: ignore[arg-type]
        (statement,) = parsed_python(b'"\\d"').body
    assert isinstance(statement, ast.Expr)
    assert ast.literal_eval(statement.value) == "\\d"
    assert told == []


def test_what_is_no_python_is_an_error() -> None:
    with pytest.raises(SyntaxError):
        parsed_python("def")
