"""Modules of INET's nodes and networks that have no keys here: what does the same, or that nothing has to."""

from collections.abc import Iterable

_APPS = "the messages of a node are those of its protocol here, `protocol.class`"
_OBSTACLES = "obstacles are below `environment` here: `gradysim keys environment`"
_NO_ADDRESSES = "nodes are addressed by their ids here, and this line can go"
_NO_ENERGY = "there are no models of energy here, and this line can go"

_HERE = {
    "app": _APPS,
    "numApps": _APPS,
    "physicalEnvironment": _OBSTACLES,
    "configurator": _NO_ADDRESSES,
    "ipv4": _NO_ADDRESSES,
    "energyStorage": _NO_ENERGY,
    "energyGenerator": _NO_ENERGY,
    "energyManagement": _NO_ENERGY,
    "energyConsumer": _NO_ENERGY,
}


def instead_of_module(parts: Iterable[str]) -> str:
    """The end of a message for a key of these parts, "; ..."; "" if none of them is such a module."""
    names = (part.partition("[")[0] for part in parts)
    return next((f"; {_HERE[name]}" for name in names if name in _HERE), "")
