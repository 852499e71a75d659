"""The valid name that is nearest to a wrong one, for the end of error messages."""

from collections.abc import Iterable
from difflib import get_close_matches

_LEAST_PART = 4
"""Letters that are enough to look for names that hold them."""
_SLIP = 0.82


def nearest(name: str, candidates: Iterable[str]) -> str | None:
    """The candidate most like `name`, or else the only one that holds it; None if none is like it.

    The case of letters does not count, unless candidates differ in nothing else: `mw` is rather mW than MW.
    """
    by_folded: dict[str, str] = {}
    for candidate in candidates:
        known = by_folded.setdefault(candidate.casefold(), candidate)
        if _letters_in_place(name, candidate) > _letters_in_place(name, known):
            by_folded[candidate.casefold()] = candidate
    matches = get_close_matches(name.casefold(), by_folded, n=1, cutoff=0.6)
    if not matches and len(name) >= _LEAST_PART:
        matches = [candidate for candidate in by_folded if name.casefold() in candidate]
    return by_folded[matches[0]] if len(matches) == 1 else None


def _letters_in_place(name: str, candidate: str) -> int:
    return sum(map(str.__eq__, name, candidate))


def did_you_mean(name: str, candidates: Iterable[str]) -> str:
    """The end of a message, "; did you mean ...?" with the nearest candidate; "" if there is none."""
    match = nearest(name, candidates)
    return f"; did you mean `{match}`?" if match is not None else ""


def misspelt(name: str, names: Iterable[str]) -> str | None:
    """The one of `names` that `name` is, but for a letter exchanged, missing or too many.

    For names among which any others may stand: a stricter judge than `nearest`. The case of letters and what
    joins words do not count.
    """
    by_letters = {_letters(valid): valid for valid in names}
    matches = get_close_matches(_letters(name), by_letters, n=1, cutoff=_SLIP)
    return by_letters[matches[0]] if matches else None


def _letters(name: str) -> str:
    return "".join(filter(str.isalnum, name.casefold()))
