"""gradysim: one protocol, run on ever more realistic networks of flying nodes."""

from typing import TYPE_CHECKING, Any

from gradysim import installation

if TYPE_CHECKING:
    from gradysim.stepping import start

__all__ = ["__version__", "start"]

installation.check(__path__)

__version__: str
"""Version of the installed package, with its commit if it is not a release.

An editable installation adds `editable`, since its sources may have changed after that commit.
"""


def __getattr__(name: str) -> Any:
    """Look up the public names on first use, since what they import is slow to import."""
    if name == "start":
        from importlib import import_module

        return import_module("gradysim.stepping").start
    if name == "__version__":
        from importlib.metadata import distribution

        installed = distribution("gradysim")
        if '"editable": true' not in (installed.read_text("direct_url.json") or ""):
            return installed.version
        return installed.version + (".editable" if "+" in installed.version else "+editable")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
