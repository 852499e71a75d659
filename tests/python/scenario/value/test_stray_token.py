import pytest

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.expression import parse_value

LIST = "; a list of values is written `${1ms, 2ms}`"


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("1ms, 2ms", LIST),
        ("1,2", f"{LIST}, a fraction `0.5`"),
        ("{1ms}", LIST),
        ("[1ms]", LIST),
        ("1ms..5ms", "; a range of values is written `${1..5}ms`"),
        ("5s // five", "; a comment begins with `#`"),
        ("$speed", "; did you mean `${speed}`?"),
        ("$", ""),
        ("1.5.", ""),
        ("3 * / 2", ""),
    ],
)
def test_what_other_grammars_have_there(text: str, hint: str) -> None:
    with pytest.raises(BadValue) as caught:
        parse_value(text)
    assert caught.value.problem.endswith(" is not understood there")
    assert caught.value.hint == hint


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("10\N{NO-BREAK SPACE}m", "`\N{NO-BREAK SPACE}` (U+00A0, no-break space)"),
        ("\N{MINUS SIGN}10m", "`\N{MINUS SIGN}` (U+2212, minus sign)"),
        (
            "\N{LEFT DOUBLE QUOTATION MARK}a",
            "`\N{LEFT DOUBLE QUOTATION MARK}` (U+201C, left double quotation mark)",
        ),
        ("5 \x91", "`\x91` (U+0091, without a name)"),
        ('5 "\N{MINUS SIGN}"', '`"\N{MINUS SIGN}"`'),
    ],
)
def test_a_character_that_looks_like_another_is_named(text: str, problem: str) -> None:
    with pytest.raises(BadValue) as caught:
        parse_value(text)
    assert caught.value.problem == f"{problem} is not understood there"


@pytest.mark.parametrize("micro", ["\N{MICRO SIGN}", "\N{GREEK SMALL LETTER MU}"])
def test_a_micro_has_a_letter_of_its_own(micro: str) -> None:
    with pytest.raises(BadValue) as caught:
        parse_value(f"100{micro}s")
    assert caught.value.hint == "; a micro is `u`, as in `us`"
