"""The unit of a protocol's parameter, where something says it.

Native protocols declare theirs. A class attribute in Python has no place for a unit but the end of its name,
and only ends that hardly mean anything else count: `timeout_ms` and `power_dbm`, not `vector_x`, `point_a`,
`size_b` or the `rician_k` that is no temperature.
"""

from gradysim.config.native_protocol import NativeProtocol
from gradysim.config.units import UNITS
from gradysim.protocol.interface import IProtocol

_BY_END = {
    name.lower(): name
    for name in (
        "s", "ms", "us", "m", "km", "mps", "kmph", "Hz", "kHz", "MHz", "GHz", "bps", "kbps", "Mbps", "rad",
        "deg", "W", "mW", "dBm", "dBW", "dB",
    )
}  # fmt: skip


def unit_of(cls: type[IProtocol], name: str) -> str | None:
    """The name of the unit that the parameter `name` of a protocol is in; None if nothing says it."""
    if issubclass(cls, NativeProtocol):
        declared = cls._parameters.get(name)
        return declared.unit if declared is not None and declared.unit in UNITS else None
    _, underscore, end = name.rpartition("_")
    return _BY_END.get(end) if underscore else None
