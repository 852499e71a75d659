"""Sees to it that what is given as a protocol is the class of one."""

from gradysim.protocol.interface import IProtocol


def checked_protocol_class(protocol: type[IProtocol]) -> type[IProtocol]:
    """Return it; TypeError if it is no class, or one that has no `instantiate`."""
    if not isinstance(protocol, type) or not hasattr(protocol, "instantiate"):
        raise TypeError(f"expected a protocol's class, a subclass of IProtocol, got {protocol!r}")
    return protocol
