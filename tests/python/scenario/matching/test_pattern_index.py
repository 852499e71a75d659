from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.matching.pattern_index import PatternIndex
from gradysim.scenario.patterns import compile_pattern

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
