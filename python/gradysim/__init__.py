"""gradysim: one protocol, run on ever more realistic networks of flying nodes."""

from typing import Any

from gradysim import installation

installation.check(__path__)

__version__: str
"""Version of the installed package, with its commit if it is not a release.

An editable installation adds `editable`, since its sources may have changed after that commit.
"""


def __getattr__(name: str) -> Any:
    """Look up `__version__` on first use, since importlib.metadata is slow to import."""
    if name == "__version__":
        from importlib.metadata import distribution

        installed = distribution("gradysim")
        if '"editable": true' not in (installed.read_text("direct_url.json") or ""):
            return installed.version
        return installed.version + (".editable" if "+" in installed.version else "+editable")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
