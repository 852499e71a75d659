"""`interval = 5m` is five metres, and a minute is `min`.

Where something says that a parameter of a protocol is a time, metres are refused. Where nothing does, they
are converted to SI units as all quantities are: a protocol that takes its interval for seconds then has 5 of
them in the place of 300. The names of some parameters leave little doubt.
"""

import re
from collections.abc import Iterable, Iterator

from gradysim.config.error import BadValue
from gradysim.config.expression import parse_value
from gradysim.config.node_spec import NodeSpec
from gradysim.config.parameter_unit import unit_of
from gradysim.config.quantity import Quantity
from gradysim.config.source import Source

_TIMES = ("interval", "timeout", "period", "delay", "duration")
"""What names of times end in."""


_METRES_IN_A_LIST = re.compile(r"[\d.]\s*m\b|[,.][^{}]*\}\s*m\b", re.ASCII)
"""`${5m, 10m}`, `${5, 10}m` and `${5..10}m`, but not `${runnumber}m`."""


def metres_for_times(nodes: Iterable[NodeSpec]) -> Iterator[str]:
    """Yield one line of text for each, "FILE:LINE: warning: ..."."""
    seen: set[int] = set()  # nodes with the same lines in force share their sources
    told: set[Source] = set()
    for spec in nodes:
        if id(spec.protocol_sources) in seen:
            continue
        seen.add(id(spec.protocol_sources))
        for name, source in spec.protocol_sources.items():
            if not _is_named_like_a_time(name) or unit_of(spec.protocol, name) is not None:
                continue
            if source not in told and _is_in_metres(source.value):
                told.add(source)
                yield (
                    f"{source}: warning: `{name}` is given in metres, `m`; a minute is `min` (in"
                    f' {spec.protocol.__name__}, `{name}: Annotated[float, "m"]` says that metres are meant)'
                )


def _is_named_like_a_time(name: str) -> bool:
    """A jitter alone is one of times; that of something else, as in `position_jitter`, may be anything."""
    return name.casefold().endswith(_TIMES) or name == "jitter"


def _is_in_metres(text: str) -> bool:
    try:
        value = parse_value(text)
    except BadValue:  # with a variable in it, or a list of values
        return "${" in text and '"' not in text and _METRES_IN_A_LIST.search(text) is not None
    return isinstance(value, Quantity) and value.unit is not None and value.unit.name == "m"
