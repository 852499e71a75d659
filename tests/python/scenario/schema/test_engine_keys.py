import importlib.util
import math
from pathlib import Path

import pytest

from gradysim.protocol.defaults import LEAST_TELEMETRY_INTERVAL_S, SPEED_MPS, UPDATE_S
from gradysim.scenario.schema.engine_keys import engine_keys

_netsim = pytest.importorskip("gradysim._netsim")

WRITER = Path(__file__).parents[4] / "cpp" / "schema" / "write_schema.py"


@pytest.fixture(scope="module")
def writer():
    spec = importlib.util.spec_from_file_location("write_schema", WRITER)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(("file", "text"), [("SCHEMA", "schema_text"), ("STUB", "stub_text")])
def test_the_files_are_what_make_schema_writes(writer, file, text):
    written = getattr(writer, file).read_text(encoding="utf-8")
    assert written == getattr(writer, text)(_netsim.schema()), "run `make schema`"


def test_each_declared_field_is_one_of_the_engine():
    interface = _netsim.NodeConfig("node").wlan[0]
    structs = {
        "medium": _netsim.MediumConfig(),
        "obstacle": _netsim.ObstacleConfig(),
        "mobility": _netsim.MobilityConfig(),
        "interface": interface,
        "radio": interface.radio,
        "antenna": interface.radio.antenna,
        "mac": interface.mac,
        "csma": interface.csma,
        "wind": _netsim.WindConfig(),
        "computer": _netsim.ComputerConfig(),
    }
    for struct, keys in engine_keys().items():
        for key in keys:
            if key.defaults:
                assert getattr(structs[struct], key.field) == key.defaults[""], key.path


def default(target):
    (key,) = (key for keys in engine_keys().values() for key in keys if key.target == target)
    return key.defaults[""]


def test_nodes_move_the_same_in_both_modes_by_default():
    assert default("mobility.speed_mps") == SPEED_MPS
    assert default("mobility.telemetry_interval_s") == UPDATE_S


def test_the_least_telemetry_interval_is_the_same_in_both_modes():
    config = _netsim.MobilityConfig()
    config.telemetry_interval_s = LEAST_TELEMETRY_INTERVAL_S
    config.validate()
    config.telemetry_interval_s = math.nextafter(LEAST_TELEMETRY_INTERVAL_S, 0)
    with pytest.raises(_netsim.ConfigError) as error:
        config.validate()
    assert error.value.field == "mobility.telemetry_interval_s"
