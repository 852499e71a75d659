"""Which node a command may name as its destination: the id, or what equals it.

Prototype mode finds nodes in a dictionary, so that an integer of NumPy or `1.0` does as well as 1. The
engine calls this for what is no plain id, so that integrated mode takes the same.
"""

from gradysim.protocol.errors import CommunicationException

_LARGEST_ID = 2**31 - 1


def checked_destination(destination: object) -> int:
    """Return the id. Raises CommunicationException if nothing that is one equals it."""
    try:
        hash(destination)  # what has none is found in no dictionary
        number = int(destination)  # type: ignore[call-overload]
    except (TypeError, ValueError, OverflowError):
        number = -1
    if number == destination and 0 <= number <= _LARGEST_ID:
        return int(number)
    raise CommunicationException(f"destination must be an int, the id of a node, got {destination!r}")
