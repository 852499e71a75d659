"""Classes of protocols on their way to another process, and back; see origin."""

from functools import lru_cache

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.protocol.loader import ProtocolLoader
from gradysim.scenario.protocol.native import NativeProtocol, native_protocol
from gradysim.scenario.protocol.origin import Origin, class_loaded_from, origin_of


def portable(cls: type[IProtocol]) -> type[IProtocol] | Origin:
    """Return what `pickle` can take to another process in the place of a class."""
    if issubclass(cls, NativeProtocol):
        return Origin(None, cls.__name__)
    return origin_of(cls) or cls


def class_from(ported: type[IProtocol] | Origin) -> type[IProtocol]:
    """Return the class of what `portable` made of it; in another process its file is loaded, once.

    Raises:
        BadValue: It does not load there.
    """
    if not isinstance(ported, Origin):
        return ported
    if ported.file is None:
        return native_protocol(ported.name)
    known = class_loaded_from(ported)
    if known is None:
        known = _loader(ported.load).load(f"{ported.file}:{ported.name}", ported.file.parent)
    return known


@lru_cache(maxsize=16)
def _loader(load: str) -> ProtocolLoader:
    """Return this process's counterpart of a loader of another one: here, too, its classes share modules."""
    return ProtocolLoader(load)
