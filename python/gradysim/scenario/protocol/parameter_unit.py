"""The unit of a protocol's parameter, where something says it.

Native protocols declare theirs. A class attribute in Python may have it in its annotation, as in
`interval: Annotated[float, "s"] = 5.0`. Otherwise the end of its name says it, and only ends that hardly
mean anything else count: `timeout_ms` and `power_dbm`, not `vector_x`, `point_a`, `size_b` or the `rician_k`
that is no temperature.
"""

import inspect
import re

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.protocol.native import NativeProtocol
from gradysim.scenario.units import UNITS, UNITS_IN_NAMES

_BY_END = {name.lower(): name for name in UNITS_IN_NAMES}

_ANNOTATED = re.compile(r"""\bAnnotated\[[^"']*, *["'](\w+)["']""")
"""In the text of an annotation, which may be all there is of it."""


def unit_of(cls: type[IProtocol], name: str) -> str | None:
    """The name of the unit that the parameter `name` of a protocol is in; None if nothing says it."""
    if issubclass(cls, NativeProtocol):
        declared = cls._parameters.get(name)
        return declared.unit if declared is not None and declared.unit in UNITS else None
    for base in cls.__mro__:
        if name in (annotations := annotations_of(base)):
            annotated = _ANNOTATED.search(str(annotations[name]))
            if annotated and annotated[1] in UNITS:
                return annotated[1]
            break
    _, underscore, end = name.rpartition("_")
    return _BY_END.get(end) if underscore else None


def annotations_of(cls: type) -> dict[str, object]:
    """The annotations of a class alone, without those of its bases; a text where they are written as one."""
    try:
        return dict(inspect.get_annotations(cls))
    except NameError:  # names that exist for type checkers only; Python 3.14 looks them up here
        return {}
