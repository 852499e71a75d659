"""Classes of protocols for a run that begins anew: what runs before it have left in them is not there."""

from collections.abc import Iterable

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.protocol.loader import ProtocolLoader
from gradysim.scenario.protocol.origin import loader_of, origin_of


def loaded_anew(classes: Iterable[type[IProtocol]]) -> dict[type[IProtocol], type[IProtocol]]:
    """Return {class: the same, its file run once more}.

    The files run as they were when they were read, whatever was edited since, and those of one loader share
    what they import from their folders. Classes that are imported by the names of their modules, and native
    ones, are left out: Python has each module once.
    """
    loaders: dict[int, ProtocolLoader] = {}
    anew = {}
    for cls in classes:
        origin, modules = origin_of(cls), loader_of(cls)
        if origin is not None and origin.file is not None and modules is not None:
            loader = loaders.setdefault(id(modules), ProtocolLoader(modules=modules.anew()))
            anew[cls] = loader.load(f"{origin.file}:{origin.name}", origin.file.parent)
    return anew
