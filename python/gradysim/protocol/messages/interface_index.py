"""Which network interface a command may name: the one check of both modes.

The engine calls it for what is no plain index, and knows itself how many interfaces the node has. Prototype
mode, which has no interfaces, takes every index that some node could have.
"""

from gradysim.protocol.errors import CommunicationException

MOST_INTERFACES = 16
"""Of a node; the engine's bound."""


def checked_interface(interface: object) -> int:
    """Return the index. Raises CommunicationException if no node can have such an interface."""
    if isinstance(interface, int) and not isinstance(interface, bool) and 0 <= interface < MOST_INTERFACES:
        return interface
    raise CommunicationException(
        f"interface must be an int from 0 to {MOST_INTERFACES - 1}, such as 1 for wlan[1], got {interface!r}"
    )
