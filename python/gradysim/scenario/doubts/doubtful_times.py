"""`interval = 5m` is five metres, and a minute is `min`; `timeout = 5Hz` is no time either.

Where something says what a parameter of a protocol measures (see parameter_unit), all else is refused. Where
nothing does, any quantity is taken and converted to its SI unit: a protocol that takes its interval for
seconds then has 5 of them in the place of 300. Names that end in a word for times leave little doubt, so that
other quantities are told; they are taken all the same, as an interval may be one of metres. A `jitter` is one
of times where nothing else is said, and a `position_jitter` is not.
"""

import re
from collections.abc import Iterable, Iterator

from gradysim.scenario.errors import BadValue, Source
from gradysim.scenario.node.node_spec import NodeSpec
from gradysim.scenario.protocol.parameter_unit import unit_of
from gradysim.scenario.value.expression import parse_value
from gradysim.scenario.value.parameter_context import ParameterContext, differs_between_parameters
from gradysim.scenario.value.quantity import Quantity
from gradysim.scenario.value.units import Dimension, Unit

_ENDS = ("interval", "timeout", "period", "delay", "duration")
"""What names of times end in."""

_WHOLE_NAMES = ("jitter", "spread", "offset")
"""Names of times that with another word before them may be anything."""

_METRES_IN_A_LIST = re.compile(r"[\d.]\s*m\b|[,.][^{}]*\}\s*m\b", re.ASCII)
"""`${5m, 10m}`, `${5, 10}m` and `${5..10}m`, but not `${runnumber}m`."""


def doubtful_times(nodes: Iterable[NodeSpec]) -> Iterator[str]:
    """Yield one line of text for each, "FILE:LINE: warning: ..."."""
    seen: set[int] = set()  # nodes with the same lines in force share their sources
    told: set[Source] = set()
    for spec in nodes:
        is_like_one_before = id(spec.protocol_sources) in seen
        seen.add(id(spec.protocol_sources))
        for name, source in spec.protocol_sources.items():
            if is_like_one_before and not differs_between_parameters(source.value):
                continue
            if not _is_named_like_a_time(name) or unit_of(spec.protocol, name) is not None:
                continue
            unit = _unit_of_no_time(source.value, f"{spec.name}.protocol.{name}")
            if source not in told and unit:
                told.add(source)
                hint = "; a minute is `min`" if unit == "m" else ""
                yield (
                    f"{source}: warning: `{name}` is given in `{unit}`, and by its name it is a time{hint}"
                    f" (in {spec.protocol.__name__}, "
                    f'`{name}: Annotated[float, "{unit}"]` says that it is none)'
                )


def _is_named_like_a_time(name: str) -> bool:
    folded = name.casefold()
    return folded in _WHOLE_NAMES or folded.endswith(_ENDS)


def _unit_of_no_time(text: str, path: str) -> str:
    """The name of the unit that the text has for that parameter, if it is none of times; else "".

    What is drawn is drawn anew: the unit hardly ever depends on it.
    """
    try:
        value = parse_value(text, ParameterContext(0, path))
    except BadValue:  # with a variable in it, or a list of values
        return "m" if "${" in text and '"' not in text and _METRES_IN_A_LIST.search(text) else ""
    unit: Unit | None = value.unit if isinstance(value, Quantity) else None
    return unit.name if unit is not None and unit.dimension is not Dimension.TIME else ""
