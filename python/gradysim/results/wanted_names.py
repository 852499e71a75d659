"""Which of many results are wanted, by patterns of their names."""

from collections.abc import Callable, Iterable
from fnmatch import fnmatchcase

Names = str | Iterable[str]
"""A name, or several; with `*` for any letters and `?` for any one."""


def wanted(names: Names | None) -> Callable[[str], bool]:
    """Return what tells whether a name fits; without any names each does."""
    if names is None:
        return lambda _: True
    # A bracket is a bracket, as in `received[0]:last`.
    patterns = [name.replace("[", "[[]") for name in ([names] if isinstance(names, str) else names)]
    return lambda name: any(fnmatchcase(name, pattern) for pattern in patterns)
