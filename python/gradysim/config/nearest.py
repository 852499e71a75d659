"""The valid name that is nearest to a wrong one, for the end of error messages."""

from collections.abc import Iterable
from difflib import get_close_matches


def nearest(name: str, candidates: Iterable[str]) -> str | None:
    """The candidate most like `name`, or None if none is like it. The case of letters counts little."""
    by_folded: dict[str, str] = {}
    for candidate in candidates:
        by_folded.setdefault(candidate.casefold(), candidate)
    matches = get_close_matches(name.casefold(), by_folded, n=1, cutoff=0.6)
    return by_folded[matches[0]] if matches else None


def did_you_mean(name: str, candidates: Iterable[str]) -> str:
    """The end of a message, "; did you mean ...?" with the nearest candidate; "" if there is none."""
    match = nearest(name, candidates)
    return f"; did you mean `{match}`?" if match is not None else ""
