import re

import pytest

from gradysim.scenario.value.quoted import QUOTED, is_quoted, unquoted


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ('a "b" c', '"b"'),
        (r'"a \" b" + "c"', r'"a \" b"'),
        (r'"a \\" + "b"', r'"a \\"'),
        ('"two\nlines"', '"two\nlines"'),
        ('""', '""'),
    ],
)
def test_the_first_text_ends_at_its_own_quote(text: str, found: str) -> None:
    match = re.search(QUOTED, text, re.DOTALL)
    assert match is not None
    assert match[0] == found


def test_an_open_quote_is_no_text() -> None:
    assert re.search(QUOTED, r'"a \"', re.DOTALL) is None


@pytest.mark.parametrize("text", ['"a" + "b"', '"a', 'a"', '"', "a", '"a" ', r'"a\"'])
def test_what_is_no_text_alone(text: str) -> None:
    assert not is_quoted(text)


@pytest.mark.parametrize(
    ("written", "text"),
    [('""', ""), (r'"c\"d"', 'c"d'), (r'"\\n"', r"\n"), (r'"a\n\t\rb\c"', "a\n\t\rbc")],
)
def test_the_text_between_the_quotes(written: str, text: str) -> None:
    assert is_quoted(written)
    assert unquoted(written) == text
