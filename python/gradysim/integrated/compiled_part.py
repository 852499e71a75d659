"""The compiled engine, imported only when a run needs it."""

from types import ModuleType


class CompiledPartMissingError(ImportError):
    """The engine is not built for this Python. Prototype mode works without it."""


def load_netsim() -> ModuleType:
    """Return `gradysim._netsim`. CompiledPartMissingError says how to build it."""
    try:
        from gradysim import _netsim
    except ImportError as reason:
        raise CompiledPartMissingError(
            "integrated mode needs the compiled part of gradysim, which cannot be imported"
            f" ({reason}): run `pip install .` in the sources, or choose `--mode prototype`"
        ) from reason
    return _netsim
