"""Draws that need not be made to know that nothing is wrong with them, whatever the seed."""

import re

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.drawing_functions import drawing_function_in
from gradysim.scenario.value.expression import parse_value
from gradysim.scenario.value.kinds import Kind

_UNIFORM = re.compile(r'\s*uniform\s*\(([^(),"]*),([^(),"]*)\)\s*', re.ASCII)


def is_safe(text: str, kind: Kind) -> bool:
    """Whether a value that one seed made one of that kind is so with every other seed.

    That is known of `uniform(0m, 1km)` where all that lies between two values may stand: both ends may.
    """
    if not drawing_function_in(text):
        return True
    ends = _UNIFORM.fullmatch(text)
    if ends is None or not kind.has_all_between:
        return False
    try:
        for end in ends.groups():
            kind.convert(parse_value(end))
    except BadValue:  # too far away, or another one for each parameter
        return False
    return True
