"""Named streams of random numbers, so that nobody's draws disturb anybody else's."""

from random import Random


def random_stream(seed: int, node_id: int, purpose: str) -> Random:
    """Return the stream of one node for one purpose in the run with that seed.

    Equal arguments give equal streams, on every platform: a text seeds the generator through SHA-512.
    """
    return Random(f"{seed}/{node_id}/{purpose}")
