import sys
from collections.abc import Callable
from types import FrameType
from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from gradysim.scenario.errors import BadValue
from gradysim.scenario.parse.patterns import PatternIndex, compile_pattern


def matches(pattern: str, path: str) -> bool:
    return compile_pattern(pattern).matches(path)


@pytest.mark.parametrize(
    ("pattern", "path", "expected"),
    [
        ("*.uavs[*].mobility.speed", "Network.uavs[12].mobility.speed", True),
        ("*.uavs[*].mobility.speed", "Network.sub.uavs[12].mobility.speed", False),
        ("*.uavs[*].mobility.speed", "Network.uavs.mobility.speed", False),
        ("**.speed", "Network.uavs[12].mobility.speed", True),
        ("**.speed", "speed", False),
        ("**.mobility.**", "Network.uavs[12].mobility.speed", True),
        ("*", "a.b", False),
        ("**", "a.b", True),
        ("a?c", "abc", True),
        ("a?c", "a.c", False),
        ("a?c", "ac", False),
        ("{a-c}x", "bx", True),
        ("{a-c}x", "dx", False),
        ("{a-cX-Z_}x", "Yx", True),
        ("{^a-c}x", "dx", True),
        ("{^a-c}x", "bx", False),
        ("{-a}", "-", True),
        ("{a-}", "-", True),
        ("{a^}", "^", True),
        ("{]}", "]", True),
        ("n[3..5]", "n[4]", True),
        ("n[3..5]", "n[6]", False),
        ("n[3..]", "n[1000]", True),
        ("n[3..]", "n[2]", False),
        ("n[..5]", "n[0]", True),
        ("n[..5]", "n[6]", False),
        ("n[..]", "n[6]", True),
        ("n[3..5]", "n4", False),
        ("n{3..5}", "n4", True),
        ("n{3..5}*", "n42", False),
        ("n{3..5}*", "n4x", True),
        ("n{3..5}", "n04", True),
        ("n{3..}", "n007", True),
        ("n[" + "0" * 500 + "3..0004]", "n[4]", True),
        ("n[3]", "n[3]", True),
        ("n[3]", "n[30]", False),
        (r"a\*", "a*", True),
        (r"a\*", "ab", False),
        (r"\{a}", "{a}", True),
        ("a.b", "axb", False),
        ("a(b)+", "a(b)+", True),
        ("A", "a", False),
    ],
)
def test_examples(pattern: str, path: str, expected: bool) -> None:
    assert matches(pattern, path) is expected


@pytest.mark.parametrize(
    "pattern",
    [
        "a{b",
        "a[5..3]",
        "a[0..1000000000000000000]",
        "a[" + "9" * 500 + "..]",
        "a{z-b}",
        "a\\",
        "{^}",
    ],
)
def test_wrong_patterns_are_refused(pattern: str) -> None:
    with pytest.raises(BadValue) as error:
        compile_pattern(pattern)
    assert error.value.suggestion == error.value.hint == ""


@given(st.integers(0, 2000), st.integers(0, 2000), st.integers(0, 3000))
def test_number_ranges_hold_just_their_numbers(low: int, high: int, number: int) -> None:
    low, high = min(low, high), max(low, high)
    assert matches(f"a{{{low}..{high}}}b", f"a{number}b") is (low <= number <= high)
    assert matches(f"a[{low}..]", f"a[{number}]") is (low <= number)
    assert matches(f"a[..{high}]", f"a[{number}]") is (number <= high)


@given(st.text())
def test_an_escaped_text_matches_itself_only(text: str) -> None:
    pattern = compile_pattern("".join(f"\\{character}" for character in text))
    assert pattern.matches(text)
    assert pattern.literal == text
    assert not pattern.matches(text + "x")


def _matches_slowly(pattern: str, path: str) -> bool:
    """Match wildcards by their definition, one character after the other."""
    if not pattern:
        return not path
    if pattern.startswith("**"):
        return any(_matches_slowly(pattern[2:], path[count:]) for count in range(len(path) + 1))
    if pattern[0] == "*":
        end = path.find(".") if "." in path else len(path)
        return any(_matches_slowly(pattern[1:], path[count:]) for count in range(end + 1))
    fits = path[:1] != "" and (path[0] != "." if pattern[0] == "?" else path[0] == pattern[0])
    return fits and _matches_slowly(pattern[1:], path[1:])


def steps_of(pattern: str, path: str) -> int:
    """Return the lines of Python and the calls of regular expressions in a comparison of pattern and path."""
    compiled = compile_pattern(pattern)
    compiled.matches("")  # it caches its expressions
    steps = 0

    def count(frame: FrameType, event: str, _: object) -> Callable[..., Any]:
        nonlocal steps
        steps += event == "line"
        return count

    def count_calls(frame: FrameType, event: str, _: object) -> None:
        nonlocal steps
        steps += event == "c_call"

    sys.settrace(count)
    sys.setprofile(count_calls)
    try:
        compiled.matches(path)
    finally:
        sys.setprofile(None)
        sys.settrace(None)
    return steps


@given(st.text("ab.*?", max_size=60), st.text("ab.", max_size=60))
@example("*a" * 30 + "*b", "a" * 60)
@example("**.*a" * 9 + "b", "a." * 30)
@example("*" * 60, "a." * 30)
def test_steps_grow_with_the_product_of_both_lengths_at_most(pattern: str, path: str) -> None:
    assert steps_of(pattern, path) <= 20 + 6 * (len(pattern) + 1) * (len(path) + 1)


@pytest.mark.parametrize("stars", [1, 2, 3, 4, 5, 30, 400])
def test_no_number_of_wildcards_takes_long(stars: int) -> None:
    path = "a" * 500
    assert steps_of("*a" * stars + "*b", path) <= 20 + 6 * (2 * stars + 2) * len(path)
    assert not matches("*a" * stars + "*b", path)
    assert matches("*a" * stars + "*", path)


@pytest.mark.parametrize("text", ["a" * 1001, "*a" * 501])
def test_a_pattern_that_is_too_long_is_refused(text: str) -> None:
    with pytest.raises(BadValue, match=str(len(text))) as error:
        compile_pattern(text)
    assert error.value.expected.endswith(" 1000")


@given(st.text("ab.*?", max_size=9), st.text("ab.", max_size=6))
def test_wildcards_mean_what_their_definition_says(pattern: str, path: str) -> None:
    assert matches(pattern, path) is _matches_slowly(pattern, path)


@pytest.mark.parametrize(
    ("pattern", "parts"),
    [
        ("*.uavs[*].mobility.speed", ["*", "uavs[*]", "mobility.speed"]),
        ("*.numUavs", ["*", "numUavs"]),
        ("*.uavs[0..2].**.power", ["*", "uavs[0..2]", "**.power"]),
        ("*.{a-c}.x", ["*", "{a-c}", "x"]),
        (r"*.a\.b", ["*", "a", "b"]),  # an escaped dot is still a dot
        (r"*.a\*", ["*", r"a\*"]),
        ("**.power", None),
        ("*.**", None),
        ("*.{^a}.x", None),
        ("*.{--0}.x", None),
        ("plain", ["plain"]),
    ],
)
def test_splits_below_the_network_and_the_node(pattern: str, parts: list[str] | None) -> None:
    split = compile_pattern(pattern).split()
    assert (None if split is None else [part.text for part in split]) == parts


@given(
    st.from_regex(r"[a-c*?.]{1,4}(\[[0-9*]\]|\{a-c\})?\.[a-c*?.]{1,4}", fullmatch=True),
    st.text("abc.0[]", max_size=8),
)
def test_the_parts_of_a_split_match_the_parts_of_a_path(pattern: str, path: str) -> None:
    whole = compile_pattern(pattern)
    parts = whole.split()
    names = path.split(".", 2)
    if parts is not None:
        apart = len(parts) == len(names) and all(map(lambda part, name: part.matches(name), parts, names))
        assert whole.matches(path) is apart


@pytest.mark.parametrize(
    ("pattern", "literal", "prefix"),
    [
        ("uavs[3]", "uavs[3]", "uavs[3]"),
        ("uavs[*]", None, "uavs["),
        ("uavs[2..3]", None, "uavs["),
        ("*", None, ""),
    ],
)
def test_knows_what_is_literal(pattern: str, literal: str | None, prefix: str) -> None:
    compiled = compile_pattern(pattern)
    assert (compiled.literal, compiled.literal_prefix()) == (literal, prefix)


@pytest.mark.parametrize(
    ("pattern", "tail"),
    [("**.power", "power"), ("**.x.p*", "p*"), ("**.x.**", None), ("**", None), ("a", "a")],
)
def test_knows_its_last_part(pattern: str, tail: str | None) -> None:
    found = compile_pattern(pattern).tail
    assert (None if found is None else found.text) == tail


@pytest.mark.parametrize(
    ("pattern", "parts"),
    [
        ("**.speed", ("speed", None)),
        ("**.uavs[*].mobility.**", ("uavs[*]", "mobility.**")),
        ("**.uavs[*].", ("uavs[*]", "")),
        ("**speed", None),
        ("***.speed", None),
        ("**.**.speed", None),
        ("**.{^a}.speed", None),
        ("*.uavs[*].speed", None),
        ("**", None),
    ],
)
def test_what_is_below_anything(pattern: str, parts: tuple[str, str | None] | None) -> None:
    found = compile_pattern(pattern).below_anything
    assert (found and tuple(part and part.text for part in found)) == parts


@pytest.mark.parametrize(
    ("pattern", "group"),
    [("uavs[3]", "uavs"), ("uavs[*]", "uavs"), ("uavs[1..]", "uavs"), ("uavs", None), ("u*[3]", None)],
)
def test_the_group_that_a_name_is_of(pattern: str, group: str | None) -> None:
    assert compile_pattern(pattern).group == group


@pytest.mark.parametrize(
    ("pattern", "landmark"),
    [
        ("a.b", "b"),
        ("*.uavs[*].b", "uavs["),
        ("**.uavs[3].wlan[*].b", "uavs[3]"),
        ("*.n.**.c.**.b", "b"),
        ("a.b**", "a"),
        ("a{^x}b.c", "c"),
        (r"a\.b", "b"),
        ("**", ""),
    ],
)
def test_a_name_that_all_matching_paths_have(pattern: str, landmark: str) -> None:
    assert compile_pattern(pattern).landmark == landmark


PIECES = ["a", "b", "[3]", "[", ".", "*", "**", "?", "{^a}", "[0..3]", r"\.", "[*]"]
PATTERNS = st.lists(st.sampled_from(PIECES), max_size=7).map("".join)
TEXTS = st.lists(st.sampled_from(["a", "b", "[3]", "["]) | st.just("."), max_size=7).map("".join)


@given(st.lists(PATTERNS, max_size=8), TEXTS)
def test_an_index_finds_all_that_match_in_their_order(patterns: list[str], text: str) -> None:
    index: PatternIndex[int] = PatternIndex()
    for number, pattern in enumerate(patterns):
        index.add(compile_pattern(pattern), number)
    expected = [number for number, each in enumerate(patterns) if compile_pattern(each).matches(text)]
    assert index.matching(text) == expected
