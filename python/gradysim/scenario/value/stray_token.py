"""What to say of a part of a value that has no meaning where it stands.

Most come from another grammar: a list without `${...}`, a comment of C++, a sign that an editor has put in
the place of the one on the keyboard.
"""

import re
import unicodedata

from gradysim.scenario.errors import BadValue

_LIST = "; a list of values is written `${1ms, 2ms}`"
_SPELT = {"and": "&&", "or": "||", "not": "!"}
_MICRO = ("\N{MICRO SIGN}", "\N{GREEK SMALL LETTER MU}")


def is_operator_of_python(token: str) -> bool:
    """Whether it is a word that other languages join truths with."""
    return token in _SPELT


def not_understood(token: str, text: str) -> BadValue:
    """The error about `token` in the value `text`, with what may have been meant."""
    return BadValue(f"`{token}`{_name(token)} is not understood there", _hint(token, text))


def _name(token: str) -> str:
    """That of a character that looks like another one, or like none."""
    if len(token) > 1 or token.isascii():
        return ""
    return f" (U+{ord(token):04X}, {unicodedata.name(token, 'without a name').lower()})"


def _hint(token: str, text: str) -> str:
    if token in _MICRO:
        return "; a micro is `u`, as in `us`"
    if token == "/" and "//" in text:
        return "; a comment begins with `#`"
    if token == "$" and (name := re.search(r"\$(\w+)", text, re.ASCII)):
        return f"; did you mean `${{{name[1]}}}`?"
    if token in _SPELT:
        return f"; did you mean `{_SPELT[token]}`?"
    if token == "=":
        return "; did you mean `==`?"
    if token in ("&", "|"):
        return f"; did you mean `{token * 2}`?"
    if token == "." and ".." in text:
        return "; a range of values is written `${1..5}ms`"
    if token == "," and re.search(r"\d,\d", text):
        return f"{_LIST}, a fraction `0.5`"
    return _LIST if token in ("{", ",", "[") else ""
