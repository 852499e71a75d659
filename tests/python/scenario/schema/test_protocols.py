"""Classes named by `protocol.class`: finding them, and checking that they are callable as protocols."""

import sys
from collections.abc import Callable
from functools import partial, partialmethod, wraps
from pathlib import Path
from typing import Any

import pytest

from gradysim.protocol.interface import IProtocol
from gradysim.scenario import load_scenarios
from gradysim.scenario.errors import BadValue, ConfigError
from gradysim.scenario.schema.protocols import ProtocolLoader, check_contract
from python.quiet_protocol import Quiet


@pytest.fixture
def error_of(folder: Any) -> Callable[[str], BadValue]:
    def error_of(reference: str) -> BadValue:
        with pytest.raises(BadValue) as caught:
            ProtocolLoader().load(reference, folder.path)
        return caught.value

    return error_of


def test_loads_from_a_file_beside_the_configuration(folder: Any) -> None:
    assert ProtocolLoader().load("protocols.py:Mobile", folder.path).__name__ == "Mobile"


def test_loads_from_any_file(folder: Any) -> None:
    (folder.path / "configs").mkdir()
    assert ProtocolLoader().load("../protocols.py:Mobile", folder.path / "configs").__name__ == "Mobile"


def test_loads_from_a_module(folder: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder.path / "package_y").mkdir()
    folder.write("package_y/mobile.py", (folder.path / "protocols.py").read_text())
    monkeypatch.syspath_prepend(str(folder.path))
    cls = ProtocolLoader().load("package_y.mobile:Mobile", Path("elsewhere"))
    assert cls is sys.modules["package_y.mobile"].Mobile


@pytest.mark.parametrize(
    ("reference", "suggestion"),
    [
        ("protocols.py", ""),
        ("protocols.py:", ""),
        (":Mobile", ""),
        ("protocols.Mobile", "protocols.py:Mobile"),
        ("n" * 5000 + ".Mobile", ""),
        ("elsewhere.Mobile", ""),
        ("protocol.py:Mobile", "protocols.py"),
        ("protocols.py:Mobil", "Mobile"),
        ("protocols.py:Zzz", "; there are Sensor, Mobile, Half"),
        ("protocols.py:Other", "; there are Sensor, Mobile, Half"),
        ("protocols.py:IProtocol", "; there are Sensor, Mobile, Half"),
        ("protocols.py:Half", ""),
        ("no_such_package.mobile:Mobile", ""),
        ("json.no_such:Mobile", ""),
        ("protocols:Mobile", "protocols.py:Mobile"),
    ],
)
def test_a_reference_that_leads_to_no_protocol_has_a_suggestion(
    error_of: Any, reference: str, suggestion: str
) -> None:
    error = error_of(reference)
    assert (error.suggestion or error.hint) == suggestion


def test_missing_methods_and_methods_that_look_like_them_are_named(folder: Any, error_of: Any) -> None:
    half = "from protocols import Mobile, Half\nclass Slips(Half):\n"
    methods = ("initialise", "handle_packets", "handle_telemetry", "on_timer", "finish")
    folder.write("slips.py", half + "".join(f"    def {name}(self, *_): ...\n" for name in methods))
    error = error_of("slips.py:Slips")
    assert "handle_packet(), handle_timer()" in error.problem
    assert "handle_packets()" in error.hint


REQUIRED = """from gradysim.protocol.interface import IProtocol
class Slips(IProtocol):
    def initialize(self): ...
    def handle_timer(self, timer): ...
    def handle_packet(self, message): ...
"""


@pytest.mark.parametrize(
    ("slip", "callback"),
    [
        ("handle_telemetri", "handle_telemetry"),
        ("finis", "finish"),
        ("handle_failed_mesage", "handle_failed_message"),
    ],
)
def test_an_optional_callback_with_a_typing_error_is_named(
    folder: Any, error_of: Any, slip: str, callback: str
) -> None:
    folder.write("slips.py", f"{REQUIRED}    def {slip}(self, *_): ...\n")
    error = error_of("slips.py:Slips")
    assert error.problem.endswith(f" {callback}()")
    assert error.hint.endswith(f" {slip}()")


def test_other_methods_may_be_called_like_an_optional_callback(folder: Any) -> None:
    folder.write(
        "longer.py", f"{REQUIRED}    def finished(self): ...\n    def handle_telemetry_data(self): ...\n"
    )
    assert ProtocolLoader().load("longer.py:Slips", folder.path).__name__ == "Slips"


@pytest.mark.parametrize(
    ("text", "error", "line"),
    [
        ("import os\nx = undefined", "NameError: name 'undefined' is not defined", 2),
        ("\n\ndef f(:", "SyntaxError: invalid syntax", 3),
        (
            "import no_such_module",
            "ModuleNotFoundError: No module named 'no_such_module'",
            1,
        ),
        (
            "import json\njson.loads('{')",
            "json.decoder.JSONDecodeError: Expecting property name",
            2,
        ),
        ("import sys\nsys.exit(3)", "SystemExit: 3", 2),
        ("import asyncio\nraise asyncio.CancelledError", "asyncio.exceptions.CancelledError", 2),
    ],
)
def test_a_file_that_does_not_load_shows_its_own_error_and_line(
    folder: Any,
    error_of: Any,
    text: str,
    error: str,
    line: int,
) -> None:
    folder.write("broken.py", text)
    problem = error_of("broken.py:Mobile").problem
    assert error in problem
    assert problem.endswith(f"broken.py:{line})")


@pytest.mark.parametrize(
    ("reference", "is_form"),
    [
        ("broken.py:Mobile", False),
        ("protocols.py:Half", False),
        ("protocols.py:Other", False),
        ("protocols.py:IProtocol", False),
        ("protocols.py:Zzz", False),
        ("protocol.py:Mobile", True),
        ("protocols.py", True),
        ("no_such_package:Mobile", True),
    ],
)
def test_the_form_of_a_reference_is_expected_where_it_leads_to_no_file(
    folder: Any, error_of: Any, reference: str, is_form: bool
) -> None:
    folder.write("broken.py", "def f(:")
    assert ('"file.py:Class"' in error_of(reference).expected) is is_form


@pytest.mark.parametrize(("name", "problem"), [("p" * 5000, "File name too long"), ("p\0", "p\0.py")])
def test_a_name_that_no_file_has_is_an_error(error_of: Any, name: str, problem: str) -> None:
    assert problem in error_of(f"{name}.py:Mobile").problem


def test_an_error_in_a_sibling_shows_the_siblings_line(folder: Any, error_of: Any) -> None:
    folder.write("broken.py", "import sibling_x")
    folder.write("sibling_x.py", "\n\n1 / 0")
    problem = error_of("broken.py:Mobile").problem
    assert "division" in problem
    assert problem.endswith("sibling_x.py:3)")


def test_a_callback_that_cannot_be_called_is_refused_with_its_line(folder: Any) -> None:
    folder.write(
        "wrong.py", "from protocols import Sensor\n\nclass Wrong(Sensor):\n    def handle_timer(self): pass\n"
    )
    with pytest.raises(ConfigError) as error:
        folder.load('[X]\n*.uavs[1].protocol.class = "wrong.py:Wrong"\n', "X")
    assert error.value.line == 7
    assert "wrong.py:4" in error.value.message


def test_the_files_of_a_protocol_are_looked_for_once(folder: Any) -> None:
    loader = ProtocolLoader()
    first = loader.files("protocols.py:Mobile", folder.path)
    assert [file.name for file in first] == ["protocols.py"]
    folder.write("helper.py", "")
    folder.write("protocols.py", "import helper")
    assert loader.files("protocols.py:Sensor", folder.path) == first


OWN = """
from pathlib import Path

from gradysim.scenario import load_scenarios
from protocols import Mobile

class Mine(Mobile): pass

{}load_scenarios(Path(__file__).parent / "own.ini")
"""
OWN_INI = '[General]\nsim-time-limit = 1s\n*.uav.protocol.class = "own.py:Mine"\n'


def test_a_file_that_reads_its_own_configuration_when_it_is_imported(folder: Any) -> None:
    folder.write("own.ini", OWN_INI)
    folder.write("own.py", OWN.format(""))
    with pytest.raises(ConfigError) as caught:
        load_scenarios(folder.path / "own.ini")
    assert caught.value.line == 3
    assert "own.py:9" in caught.value.message


def test_a_file_that_was_loaded_by_itself_loads_once_it_is_fixed(folder: Any) -> None:
    folder.write("own.ini", OWN_INI)
    folder.write("own.py", OWN.format(""))
    with pytest.raises(ConfigError):
        load_scenarios(folder.path / "own.ini")
    folder.write("own.py", OWN.format('if __name__ == "__main__": '))
    assert load_scenarios(folder.path / "own.ini")[0].nodes[0].protocol.__name__ == "Mine"


def with_members(**members: object) -> type[IProtocol]:
    return type("Tested", (Quiet,), members)


def refusal(**members: object) -> BadValue:
    with pytest.raises(BadValue) as caught:
        check_contract(with_members(**members))
    return caught.value


def traced(function: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(function)
    def wrapper(*args: Any, **keywords: Any) -> Any:
        return function(*args, **keywords)

    return wrapper


def given_a_clock(function: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(function)
    def wrapper(self: Any, timer: str) -> None:
        function(self, timer, 0.0)

    return wrapper


def with_clock(clock: float, timer: str) -> None: ...


class CallableObject:
    def __call__(self, timer: str) -> None: ...


async def coroutine(self: Any, timer: str) -> None: ...


def generator(self: Any, timer: str) -> Any:
    yield timer


async def asynchronous_generator(self: Any, timer: str) -> Any:
    yield timer


@pytest.mark.parametrize(
    ("name", "function", "problem", "expected"),
    [
        ("handle_timer", lambda self: None, "`timer` alone", "(self, timer)"),
        ("handle_timer", lambda self, timer, clock: None, "`timer` alone", "(self, timer)"),
        ("handle_packet", lambda self: None, "`message` alone", "(self, message)"),
        ("handle_packet", lambda self, *, message: None, "`message` alone", "(self, message)"),
        ("handle_telemetry", lambda: None, "`telemetry` alone", "(self, telemetry)"),
        ("handle_timer", staticmethod(lambda self, timer: None), "`timer` alone", "(self, timer)"),
        ("handle_timer", classmethod(lambda cls: None), "`timer` alone", "(self, timer)"),
        ("initialize", lambda self, stage: None, "without", "(self)"),
        ("finish", lambda: None, "without", "(self)"),
        ("__init__", lambda self, speed: None, "without", "(self)"),
        ("handle_timer", coroutine, "asynchronous", "(self, timer)"),
        ("handle_timer", asynchronous_generator, "asynchronous", "(self, timer)"),
        ("handle_timer", generator, "generator", "(self, timer)"),
        ("handle_timer", None, " None", "(self, timer)"),
        (
            "handle_failed_message",
            lambda self, message: None,
            "`message, destination, reason` alone",
            "(self, message, destination, reason)",
        ),
        ("handle_failed_message", 5, "is 5", "(self, message, destination, reason)"),
    ],
)
def test_methods_that_cannot_be_called(name: str, function: object, problem: str, expected: str) -> None:
    error = refusal(**{name: function})
    assert problem in str(error)
    assert error.expected == f"`def {name}{expected}`"


def test_the_place_of_the_function_is_named() -> None:
    line = coroutine.__code__.co_firstlineno
    assert f"test_protocols.py:{line}" in refusal(handle_timer=coroutine).problem


@pytest.mark.parametrize(
    "function",
    [
        lambda self, timer, clock=0.0: None,
        lambda self, timer, *more, **keywords: None,
        lambda *arguments: None,
        lambda self, name: None,
        staticmethod(lambda timer: None),
        classmethod(lambda cls, timer: None),
        traced(lambda self, timer: None),
        given_a_clock(lambda self, timer, clock: None),
        partialmethod(lambda self, clock, timer: None, 0.0),
        partial(with_clock, 0.0),
        CallableObject(),
        print,
        property(lambda self: print),
    ],
)
def test_handlers_that_can_be_called(function: object) -> None:
    check_contract(with_members(handle_timer=function))


@pytest.mark.parametrize(
    "constructor", [lambda self: None, lambda self, speed=3.0: None, lambda *arguments, **keywords: None]
)
def test_constructors_that_can_be_called(constructor: object) -> None:
    check_contract(with_members(__init__=constructor))


def test_a_class_that_makes_its_own_instances_may_have_any_constructor() -> None:
    check_contract(
        with_members(
            __init__=lambda self, speed: None, instantiate=classmethod(lambda cls, provider: cls(speed=3.0))
        )
    )


def test_a_signature_for_display_does_not_count() -> None:
    @traced
    def handler(self: Any, timer: str) -> None: ...

    handler.__signature__ = "(self)"  # type: ignore[attr-defined]
    check_contract(with_members(handle_timer=handler))
