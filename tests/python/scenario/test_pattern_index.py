import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.pattern_index import PatternIndex, Place, TextIndex, landmarks, names_at
from gradysim.scenario.patterns import compile_pattern


@pytest.mark.parametrize(
    ("pattern", "certain"),
    [
        ("a.b", {Place(0, False): "a", Place(1, False): "b"}),
        ("*.uavs[*].b", {Place(1, True): "uavs[", Place(2, False): "b"}),
        ("*.uavs[0..3].{a-z}", {Place(1, True): "uavs["}),
        (
            "**.uavs[3].wlan[*].b",
            {Place(-3, False): "uavs[3]", Place(-2, True): "wlan[", Place(-1, False): "b"},
        ),
        ("*.n.**.c.**.b", {Place(1, False): "n", Place(-1, False): "b"}),
        ("a.b**", {Place(0, False): "a"}),
        ("a{^x}b.c", {Place(-1, False): "c"}),
        (r"a\.b", {Place(0, False): "a", Place(1, False): "b"}),
        ("**", {}),
    ],
)
def test_which_names_are_certain(pattern: str, certain: dict[Place, str]) -> None:
    places, names = landmarks(compile_pattern(pattern))
    assert dict(zip(places, names, strict=True)) == certain


def test_names_at_places() -> None:
    places = (Place(0, False), Place(1, True), Place(-1, True))
    assert names_at(places, ["a", "b[3]", "c"]) == ("a", "b[", "")
    assert names_at(places, ["a"]) is None


PIECES = ["a", "b", "[3]", "[", ".", "*", "**", "?", "{^a}", "[0..3]", r"\.", "[*]"]
PATTERNS = st.lists(st.sampled_from(PIECES), max_size=7).map("".join)
TEXTS = st.lists(st.sampled_from(["a", "b", "[3]", "["]) | st.just("."), max_size=7).map("".join)


@given(st.lists(PATTERNS, max_size=8), TEXTS)
def test_those_that_match_in_their_order(patterns: list[str], text: str) -> None:
    index: PatternIndex[int] = PatternIndex()
    for number, pattern in enumerate(patterns):
        index.add(compile_pattern(pattern), number)
    expected = [number for number, each in enumerate(patterns) if compile_pattern(each).matches(text)]
    assert index.matching(text) == expected


@given(st.lists(TEXTS, max_size=8), st.lists(PATTERNS, max_size=3))
def test_those_that_a_pattern_matches_in_their_order(texts: list[str], patterns: list[str]) -> None:
    index = TextIndex(texts)
    for pattern in map(compile_pattern, patterns):
        expected = [text for text in dict.fromkeys(texts) if pattern.matches(text)]
        assert list(index.matches(pattern)) == expected
        assert index.has_match(pattern) == bool(expected)
        assert index.has_match(pattern) == bool(expected)
