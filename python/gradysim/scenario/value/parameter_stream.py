"""Random numbers of the values in an .ini file: a stream for each place where a value draws one.

A stream is named by the seed of the run, the path of the parameter (`uavs[3].mobility.initialX`) and the
number of the draw in its value, on nothing else: another node, another parameter or another order of reading
changes none of them, and who reads a value twice reads the same one.
"""

import hashlib

from gradysim.encapsulator.random_stream import Purpose, Words, philox4x32

_MASK_32 = 0xFFFF_FFFF


class ParameterStream:
    """Random bits, by blocks of the generator that the engine has, too."""

    def __init__(self, seed: int, path: str, place: int) -> None:
        """Start at the first block. `place` counts the draws in the value, from 0."""
        # The name of a stream, encapsulator/random_stream.py, has room for the number of a node. A path takes
        # as much as the upper half of a block's number beside it: 64 bits, so that no two paths meet.
        digest = hashlib.sha256(f"{path}\0{place}".encode()).digest()
        self._path = (int.from_bytes(digest[:4], "little"), int.from_bytes(digest[4:8], "little"))
        self._key = (seed & _MASK_32, seed >> 32 & _MASK_32)
        self._block = 0

    def _next_block(self) -> Words:
        block = philox4x32((self._block, *self._path, Purpose.PARAMETER), self._key)
        self._block += 1
        return block

    def uniform(self) -> float:
        """Uniform in [0, 1), 53 random bits."""
        return self.uniform_pair()[0]

    def uniform_pair(self) -> tuple[float, float]:
        """Two of them, independent of each other, from one block."""
        words = self._next_block()
        return _uniform(words[0], words[1]), _uniform(words[2], words[3])

    def uniform_int(self, count: int) -> int:
        """Uniform among 0 … count - 1, without bias. 0 < count <= 2^64."""
        bits = (count - 1).bit_length()
        while True:
            words = self._next_block()
            number = (words[0] << 32 | words[1]) >> 64 - bits
            if number < count:
                return number


def _uniform(high: int, low: int) -> float:
    """As RandomStream.random makes a number of two words."""
    return (high >> 5 << 26 | low >> 6) * 2.0**-53
