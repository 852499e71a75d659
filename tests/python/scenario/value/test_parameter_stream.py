"""Streams of parameters: each a part of the generator's numbers that nobody else has."""

from gradysim.encapsulator.random_stream import Purpose, philox4x32
from gradysim.scenario.value.parameter_stream import ParameterStream

PATH = "uavs[3].mobility.initialX"


def first(seed: int = 1, path: str = PATH, place: int = 0) -> float:
    return ParameterStream(seed, path, place).uniform()


def test_the_name_gives_the_numbers() -> None:
    assert first() == first()
    others = {first(), first(seed=2), first(path="uavs[4].mobility.initialX"), first(place=1)}
    assert len(others) == 4


def test_all_64_bits_of_the_seed_count() -> None:
    assert len({first(seed=1 << bit) for bit in range(64)}) == 64


def test_the_numbers_never_change() -> None:
    """They are part of every result of a file that draws."""
    stream = ParameterStream(7, PATH, 0)
    assert [stream.uniform() for _ in range(3)] == [
        0.15135179371822116,
        0.381352411892407,
        0.2969851101537849,
    ]
    assert stream.uniform_pair() == (0.007072630869297991, 0.9760583342794937)
    assert stream.uniform_int(1000) == 819


def test_a_block_is_the_generators_with_the_path_in_the_place_of_a_node() -> None:
    # The first eight bytes of SHA-256 of the path, a zero and the place.
    path = (0xDDBDFDC8, 0x778633C0)
    words = philox4x32((0, *path, Purpose.PARAMETER), (7, 0))
    assert ParameterStream(7, PATH, 0).uniform() == ((words[0] >> 5 << 26) | words[1] >> 6) * 2.0**-53


def test_the_two_of_a_pair_are_different_and_each_block_is_another() -> None:
    stream = ParameterStream(1, PATH, 0)
    numbers = [number for _ in range(50) for number in stream.uniform_pair()]
    assert len(set(numbers)) == 100


def test_whole_numbers_are_below_the_count_and_equally_frequent() -> None:
    stream = ParameterStream(1, PATH, 0)
    counts = [0] * 5
    for _ in range(5000):
        counts[stream.uniform_int(5)] += 1
    chi_square = sum((count - 1000) ** 2 / 1000 for count in counts)
    assert chi_square < 13.28  # 99 % of 4 degrees of freedom; the seed is fixed


def test_one_whole_number_is_0_and_the_largest_count_is_understood() -> None:
    stream = ParameterStream(1, PATH, 0)
    assert stream.uniform_int(1) == 0
    assert any(stream.uniform_int(2**64) >= 2**63 for _ in range(20))
