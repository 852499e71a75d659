from typing import Annotated, ClassVar

import pytest

from gradysim.scenario.protocol.native import NativeParameter, NativeProtocol
from gradysim.scenario.protocol.parameter_unit import unit_of
from python.quiet_protocol import Quiet


class Native(NativeProtocol):
    _parameters: ClassVar = {
        "interval": NativeParameter("s", "Time between two messages"),
        "count": NativeParameter("", "Number of messages"),
        "limit_s": NativeParameter("transmissions", "Then it ends"),
    }


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("interval_s", "s"),
        ("time_out_ms", "ms"),
        ("altitude_m", "m"),
        ("carrier_mhz", "MHz"),
        ("bitrate_mbps", "Mbps"),
        ("heading_deg", "deg"),
        ("power_w", "W"),
        ("power_mw", "mW"),
        ("power_dbm", "dBm"),
        ("power_dbw", "dBW"),
        ("lost_db", "dB"),
    ],
)
def test_the_end_of_a_name_says_it(name: str, unit: str) -> None:
    assert unit_of(Quiet, name) == unit


@pytest.mark.parametrize(
    "name", ["interval", "s", "vector_x", "point_a", "size_b", "rician_k", "retry_min", "interval_S"]
)
def test_other_names_say_nothing(name: str) -> None:
    assert unit_of(Quiet, name) is None


class Annotating(Quiet):
    interval: Annotated[float, "s"] = 5.0
    as_text: "Annotated[float, 'ms']" = 5.0
    constant: ClassVar[Annotated[float, "m"]] = 1.0
    size: Annotated[int, "B", "on the air"] = 10
    delay_ms: Annotated[float, "us"] = 1.0
    speed: Annotated[float, "fast"] = 1.0
    plain: float = 1.0


class Heir(Annotating):
    interval = 2.0
    size: int = 3


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("interval", "s"),
        ("as_text", "ms"),
        ("constant", "m"),
        ("size", "B"),
        ("delay_ms", "us"),
        ("speed", None),
        ("plain", None),
    ],
)
def test_an_annotation_says_it(name: str, unit: str | None) -> None:
    assert unit_of(Annotating, name) == unit


@pytest.mark.parametrize(("name", "unit"), [("interval", "s"), ("size", None)])
def test_the_last_annotation_counts(name: str, unit: str | None) -> None:
    assert unit_of(Heir, name) == unit


@pytest.mark.parametrize(
    ("name", "unit"), [("interval", "s"), ("count", None), ("limit_s", None), ("other_s", None)]
)
def test_native_protocols_declare_theirs(name: str, unit: str | None) -> None:
    assert unit_of(Native, name) == unit
