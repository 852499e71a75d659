"""Texts in quotes, as they are written in a value."""

import re

QUOTED = r'"(?:[^"\\]|\\.)*"'
"""A regular expression, for re.DOTALL. A backslash takes the meaning from the character after it."""

_ONE_TEXT = re.compile(QUOTED, re.DOTALL)
_ESCAPED = re.compile(r"\\(.)", re.DOTALL)
_ESCAPES = {"n": "\n", "t": "\t", "r": "\r"}


def is_quoted(written: str) -> bool:
    """Whether a value is one text in quotes, and no expression of texts: `"a" + "b"` is none."""
    return _ONE_TEXT.fullmatch(written) is not None


def unquoted(written: str) -> str:
    """The text that stands in quotes."""
    return _ESCAPED.sub(lambda match: _ESCAPES.get(match[1], match[1]), written[1:-1])
