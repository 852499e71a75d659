from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.matching.text_index import TextIndex
from gradysim.scenario.patterns import compile_pattern
from python.scenario.matching.test_pattern_index import PATTERNS, TEXTS


@given(st.lists(TEXTS, max_size=8), st.lists(PATTERNS, max_size=3))
def test_those_that_a_pattern_matches_in_their_order(texts: list[str], patterns: list[str]) -> None:
    index = TextIndex(texts)
    for pattern in map(compile_pattern, patterns):
        expected = [text for text in dict.fromkeys(texts) if pattern.matches(text)]
        assert list(index.matches(pattern)) == expected
        assert index.has_match(pattern) == bool(expected)
        assert index.has_match(pattern) == bool(expected)
