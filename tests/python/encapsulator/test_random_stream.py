"""The engine's generator in Python: the same words, the same numbers, and otherwise a random.Random."""

import copy
import pickle
import re
from pathlib import Path
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.encapsulator.random_stream import Purpose, RandomStream, philox4x32

seeds = st.integers(0, 2**64 - 1)
nodes = st.integers(0, 2**31 - 1)
purposes = st.sampled_from(list(Purpose))

ONES = 0xFFFF_FFFF


@pytest.mark.parametrize(
    ("counter", "key", "expected"),
    [
        ((0, 0, 0, 0), (0, 0), (0x6627E8D5, 0xE169C58D, 0xBC57AC4C, 0x9B00DBD8)),
        ((ONES, ONES, ONES, ONES), (ONES, ONES), (0x408F276D, 0x41C83B0E, 0xA20BC7C6, 0x6D5451FD)),
        (
            (0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344),
            (0xA4093822, 0x299F31D0),
            (0xD16CFE09, 0x94FDCCEB, 0x5001E420, 0x24126EA1),
        ),
    ],
    ids=["zeroes", "ones", "digits of pi"],
)
def test_known_answers_that_the_authors_publish(counter, key, expected):
    assert philox4x32(counter, key) == expected


@given(seeds, nodes, purposes, st.lists(st.booleans(), max_size=30))
def test_words_and_numbers_are_the_engines(seed, node, purpose, wants_word):
    netsim = pytest.importorskip("gradysim._netsim")
    ours, engines = RandomStream(seed, node, purpose), netsim.RandomStream(seed, node, purpose)
    for is_word in wants_word:
        if is_word:
            assert ours.getrandbits(32) == engines.next_u32()
        else:
            assert ours.random() == engines.uniform()


def test_the_numbers_of_purposes_are_the_engines():
    header = Path(__file__).parents[3] / "cpp/netsim/kernel/random.hpp"
    (body,) = re.findall(r"enum class Purpose : std::uint32_t \{(.*?)\}", header.read_text(), re.DOTALL)
    engines = {name: int(number) for name, number in re.findall(r"(\w+) = (\d+)", body)}
    assert engines["protocol"] == Purpose.PROTOCOL
    assert engines["parameter"] == Purpose.PARAMETER
    assert engines["gusts"] == Purpose.GUSTS
    assert engines["position_error"] == Purpose.POSITION_ERROR
    assert max(engines.values()) < 100 <= Purpose.COMMUNICATION


@pytest.mark.parametrize("first", [0, 5, 2**32 - 3, 2**64 - 3])
def test_words_come_block_by_block(first):
    """For any number of words drawn at once. Block numbers have 64 bits and wrap around."""
    stream = RandomStream(0x1234567890ABCDEF, 7, Purpose.PROTOCOL)
    tag, name, _, words, gauss = stream.getstate()
    stream.setstate((tag, name, first, words, gauss))
    key = (0x90ABCDEF, 0x12345678)
    numbers = [(first + count) % 2**64 for count in range(20)]
    expected = [word for it in numbers for word in philox4x32((it % 2**32, it >> 32, 7, 3), key)]
    assert [stream.getrandbits(32) for _ in range(80)] == expected


@given(seeds, st.integers(0, 40))
def test_a_number_is_made_of_the_next_two_words(seed, drawn):
    stream, words = RandomStream(seed, 1), RandomStream(seed, 1)
    stream.getrandbits(32 * drawn)
    words.getrandbits(32 * drawn)
    high, low = words.getrandbits(32), words.getrandbits(32)
    assert stream.random() == ((high >> 5) * 2**26 + (low >> 6)) / 2**53


def test_equal_names_give_equal_streams():
    assert RandomStream(7, 3).random() == RandomStream(7, 3).random()


def test_names_of_numpy_are_those_of_ints():
    numpy = pytest.importorskip("numpy")
    stream = RandomStream(seed=numpy.int64(7), node=numpy.int32(3))
    assert stream.random() == RandomStream(seed=7, node=3).random()


def test_seed_node_and_purpose_each_make_another_stream():
    names = [(7, 3), (8, 3), (7, 4), (3, 7), (7 + 2**32, 3), (7, 3, Purpose.COMMUNICATION)]
    assert len({RandomStream(*name).random() for name in names}) == len(names)


def test_the_methods_of_random_draw_from_the_stream():
    drawn, expected = RandomStream(9, 2), RandomStream(9, 2).random()
    assert drawn.uniform(2.0, 4.0) == 2.0 + 2.0 * expected
    assert drawn.getstate() != RandomStream(9, 2).getstate()


def test_a_stream_is_the_same_on_every_platform():
    stream = RandomStream(0, 0)
    assert [stream.randrange(1000) for _ in range(5)] == [309, 861, 154, 793, 538]


@given(st.integers(0, 200))
def test_bits_are_as_many_as_asked_for(count):
    assert 0 <= RandomStream(1, 1).getrandbits(count) < 2**count


def test_a_negative_number_of_bits_is_refused():
    with pytest.raises(ValueError, match="non-negative"):
        RandomStream().getrandbits(-1)


@given(seeds, nodes, st.integers(0, 9))
def test_a_state_goes_on_where_it_was_taken(seed, node, words):
    stream = RandomStream(seed, node)
    stream.getrandbits(32 * words)
    stream.gauss(0, 1)  # stores a second number for the next call
    other = RandomStream()
    other.setstate(stream.getstate())
    assert [other.random(), other.gauss(0, 1)] == [stream.random(), stream.gauss(0, 1)]


def test_the_state_of_another_generator_is_refused():
    with pytest.raises(ValueError, match="RandomStream"):
        RandomStream().setstate(Random(1).getstate())


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda it: pickle.loads(pickle.dumps(it))])
def test_copies_go_on_alike_and_apart(copied):
    stream = RandomStream(5, 3)
    stream.getrandbits(32)
    twin = copied(stream)
    assert [twin.random() for _ in range(3)] == [stream.random() for _ in range(3)]


def test_seed_begins_again():
    stream = RandomStream(5, 3)
    first = stream.random()
    stream.seed()
    assert stream.random() == first
    stream.seed(6 + 2**40)  # all 64 bits count
    assert stream.random() == RandomStream(6 + 2**40, 3).random() != RandomStream(6, 3).random()
    stream.seed("text")
    assert stream.random() not in {first, RandomStream(6, 3).random()}
