"""gradysim: one protocol, run on ever more realistic networks of flying nodes."""

from typing import Any

__version__: str
"""Version of the installed package."""


def __getattr__(name: str) -> Any:
    """Look up `__version__` on first use, since importlib.metadata is slow to import."""
    if name == "__version__":
        from importlib.metadata import version

        return version("gradysim")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
