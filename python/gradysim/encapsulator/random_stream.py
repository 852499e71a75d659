"""Named streams of random numbers: those of the engine, in plain Python.

A stream is named by (seed of the run, node, purpose), so streams do not disturb each other. `random()`
returns bit for bit what `RandomStream::uniform()` of cpp/netsim/kernel/random.hpp gives for the same name: a
protocol draws the same numbers in both modes, and a native one the same as its counterpart in Python.

Source: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, "Parallel random numbers: as easy as 1, 2, 3",
SC 2011: Philox4x32 with 10 rounds.
"""

from enum import IntEnum
from functools import lru_cache
from operator import index
from random import Random
from struct import Struct
from typing import Any, Self

_MASK_32 = 0xFFFF_FFFF
_MASK_64 = 0xFFFF_FFFF_FFFF_FFFF
_WEYL_0 = 0x9E3779B9  # golden ratio
_WEYL_1 = 0xBB67AE85  # sqrt(3) - 1
_ROUNDS = 10

Words = tuple[int, int, int, int]


class Purpose(IntEnum):
    """Purpose of a stream. The numbers are part of every result: never change one, only add.

    The engine has those below 100, too; see `enum class Purpose`.

    Attributes:
        PROTOCOL: `IProvider.random`.
        PARAMETER: Values that an .ini file draws. The path of the parameter takes the place of the node.
        GUSTS: Gusts of wind at a vehicle.
        POSITION_ERROR: Errors of the position that a node knows.
        PROCESSING: Times that the computer of a node takes for events.
        COMMUNICATION: Lost messages of prototype mode; of the receiver.
    """

    PROTOCOL = 3
    PARAMETER = 7
    GUSTS = 9
    POSITION_ERROR = 10
    PROCESSING = 11
    COMMUNICATION = 101


def philox4x32(counter: Words, key: tuple[int, int]) -> Words:
    """128 bits of counter and 64 bits of key to 128 random bits, all in words of 32 bits."""
    return _ten_rounds(counter, _round_keys(*key), ones=1)


@lru_cache(maxsize=16)  # those of all nodes of a run are the same
def _round_keys(key_0: int, key_1: int) -> tuple[tuple[int, int], ...]:
    return tuple(
        ((key_0 + number * _WEYL_0) & _MASK_32, (key_1 + number * _WEYL_1) & _MASK_32)
        for number in range(_ROUNDS)
    )


def _ten_rounds(counter: Words, keys: tuple[tuple[int, int], ...], ones: int) -> Words:
    """Several blocks at once, one in each lane of the four integers of the counter; `ones` is 1 in each lane.

    A lane is 128 bits wide and holds a word of 32 bits, so that its products of 64 bits stay in it.
    """
    mask = _MASK_32 * ones
    word_0, word_1, word_2, word_3 = counter
    for key_0, key_1 in keys:
        product_0 = 0xD2511F53 * word_0  # the multipliers as constants: this is the hot path
        product_1 = 0xCD9E8D57 * word_2
        word_0 = product_1 >> 32 & mask ^ word_1 ^ key_0 * ones
        word_1 = product_1 & mask
        word_2 = product_0 >> 32 & mask ^ word_3 ^ key_1 * ones
        word_3 = product_0 & mask
    return word_0, word_1, word_2, word_3


_LANES = 8
"""Blocks that are drawn at once: integers in Python cost nearly the same, however long they are."""

_ONES = sum(1 << 128 * lane for lane in range(_LANES))
_NUMBERS = sum(number << 128 * lane for lane, number in enumerate(reversed(range(_LANES))))
"""The first block in the highest lane: the words of all lanes come out in the order in which a list pops."""

_LOW_WORDS = _MASK_32 * _ONES
_WORDS = Struct(f"<{4 * _LANES}I")


class RandomStream(Random):
    """The stream of one node for one purpose in the run with that seed; equal arguments give equal streams.

    All methods of `random.Random` work and draw from it. Distributions are Python's own but for `random()`.
    """

    def __new__(cls, *_: Any, **__: Any) -> Self:
        """Like `object.__new__`: the base class does not take the name of a stream."""
        return super().__new__(cls)

    def __init__(self, seed: int = 0, node: int = 0, purpose: int = Purpose.PROTOCOL) -> None:
        """Start at the first number. Of `seed` 64 bits count, of the others 32."""
        self._node = index(node) & _MASK_32
        self._purpose = int(purpose) & _MASK_32
        self._seed = index(seed) & _MASK_64  # numpy's integers would overflow
        self._begin()

    def _begin(self) -> None:
        self._keys = _round_keys(self._seed & _MASK_32, self._seed >> 32)
        self._block = 0  # number of the next one to be drawn
        self._words: list[int] = []  # of those before it, the next at the end
        self.gauss_next: float | None = None  # of the base class

    def _draw_blocks(self) -> None:
        """Put the words of the next blocks below those that are left."""
        blocks = self._block * _ONES + _NUMBERS
        self._block = self._block + _LANES & _MASK_64
        word_0, word_1, word_2, word_3 = _ten_rounds(
            (blocks & _LOW_WORDS, blocks >> 32 & _LOW_WORDS, self._node * _ONES, self._purpose * _ONES),
            self._keys,
            _ONES,
        )
        all_words = word_3 | word_2 << 32 | word_1 << 64 | word_0 << 96
        self._words[:0] = _WORDS.unpack(all_words.to_bytes(_WORDS.size, "little"))

    def random(self) -> float:
        """Uniform in [0, 1), 53 random bits: 27 of the next word, 26 of the one after it."""
        words = self._words
        if len(words) < 2:
            self._draw_blocks()
        return (words.pop() >> 5 << 26 | words.pop() >> 6) * 2.0**-53

    def getrandbits(self, k: int, /) -> int:
        """`k` random bits; ValueError if there are less than none."""
        if k < 0:
            raise ValueError("number of bits must be non-negative")
        words = self._words
        result = 0
        for shift in range(0, k, 32):
            if not words:
                self._draw_blocks()
            missing = k - shift
            word = words.pop()
            result |= (word if missing >= 32 else word >> 32 - missing) << shift
        return result

    def seed(self, a: Any = None, version: int = 2) -> None:
        """Restart the stream, with the seed `a` if it is given.

        Other values than integers are converted as `random.Random` does.
        """
        if a is not None:
            number = a if isinstance(a, int) else Random(a).getrandbits(64)
            self._seed = number & _MASK_64
        self._begin()

    def getstate(self) -> tuple[Any, ...]:
        """Return a state for `setstate` of this or another stream."""
        name = (self._seed, self._node, self._purpose)
        return ("Philox4x32-10", name, self._block, tuple(self._words), self.gauss_next)

    def setstate(self, state: tuple[Any, ...]) -> None:
        """Continue where the stream that returned `state` was; ValueError if `state` is not of a stream."""
        if len(state) != 5 or state[0] != "Philox4x32-10":
            raise ValueError("the state is not that of a RandomStream")
        self._seed, self._node, self._purpose = state[1]
        self._begin()
        self._block = state[2]
        self._words[:] = state[3]
        self.gauss_next = state[4]

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (self._seed, self._node, self._purpose), self.getstate())
