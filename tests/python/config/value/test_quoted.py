import re

import pytest

from gradysim.config.value.quoted import QUOTED


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
