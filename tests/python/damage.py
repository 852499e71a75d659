"""Random damage to the content of a file, as disks, copies and programs cause it."""

from collections.abc import Callable
from random import Random

PAGE = 4096
"""Bytes of a page of SQLite."""

_SECTOR = 512
"""Bytes that disks and incomplete copies lose at least."""


def damaged(content: bytes, random: Random) -> bytes:
    """Return content that differs from this one, which is not empty."""
    while (changed := random.choice(KINDS)(content, random)) == content:
        pass
    return changed


def _flip_bits(content: bytes, random: Random) -> bytes:
    changed = bytearray(content)
    for _ in range(random.choice([1, 1, 2, 10, 100])):
        changed[random.randrange(len(changed))] ^= 1 << random.randrange(8)
    return bytes(changed)


def _swap_pages(content: bytes, random: Random) -> bytes:
    pages = [content[begin : begin + PAGE] for begin in range(0, len(content), PAGE)]
    first, second = random.choices(range(len(pages)), k=2)
    pages[first], pages[second] = pages[second], pages[first]
    return b"".join(pages)


def _zero(content: bytes, random: Random) -> bytes:
    begin = random.randrange(len(content)) // _SECTOR * _SECTOR
    size = min(len(content) - begin, random.choice([1, 8]) * _SECTOR)
    return content[:begin] + bytes(size) + content[begin + size :]


def _truncate(content: bytes, random: Random) -> bytes:
    end = random.randrange(len(content))
    return content[: random.choice([end, end // PAGE * PAGE, len(content) - 1])]


def _append(content: bytes, random: Random) -> bytes:
    return content + random.choice([b"\n", bytes(_SECTOR), random.randbytes(10), content])


KINDS: list[Callable[[bytes, Random], bytes]] = [_flip_bits, _swap_pages, _zero, _truncate, _append]
