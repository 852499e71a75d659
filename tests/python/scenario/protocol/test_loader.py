import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.scenario import load_scenarios
from gradysim.scenario.errors import BadValue, ConfigError
from gradysim.scenario.protocol.loader import ProtocolLoader


@pytest.fixture
def error_of(folder: Any) -> Callable[[str], str]:
    def error_of(reference: str) -> str:
        with pytest.raises(BadValue) as caught:
            ProtocolLoader().load(reference, folder.path)
        return str(caught.value).replace(f"{folder.path}/", "")

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
    ("reference", "message"),
    [
        ("protocols.py", "`protocols.py` names no class"),
        ("protocols.py:", "`protocols.py:` names no class"),
        (":Mobile", "`:Mobile` names no class"),
        ("protocols.Mobile", "`protocols.Mobile` names no class; did you mean `protocols.py:Mobile`?"),
        ("n" * 5000 + ".Mobile", "`" + "n" * 5000 + ".Mobile` names no class"),
        ("elsewhere.Mobile", "`elsewhere.Mobile` names no class"),
        (
            "protocol.py:Mobile",
            "there is no file protocol.py; did you mean `protocols.py`?",
        ),
        (
            "protocols.py:Mobil",
            "protocols.py has no class `Mobil`; did you mean `Mobile`?",
        ),
        (
            "protocols.py:Zzz",
            "protocols.py has no class `Zzz`; there are Sensor, Mobile, Half",
        ),
        (
            "protocols.py:Other",
            "`Other` in protocols.py is no protocol, it does not derive from IProtocol;"
            " there are Sensor, Mobile, Half",
        ),
        (
            "protocols.py:IProtocol",
            "`IProtocol` in protocols.py is no protocol but the interface that protocols derive from;"
            " there are Sensor, Mobile, Half",
        ),
        (
            "protocols.py:Half",
            "`Half` in protocols.py is not complete, it lacks "
            "finish(), handle_packet(), handle_telemetry(), handle_timer()",
        ),
        (
            "no_such_package.mobile:Mobile",
            "this Python finds no module `no_such_package`",
        ),
        ("json.no_such:Mobile", "this Python finds no module `json.no_such`"),
        (
            "protocols:Mobile",
            "this Python finds no module `protocols`; did you mean `protocols.py:Mobile`?",
        ),
    ],
)
def test_errors(error_of: Any, reference: str, message: str) -> None:
    assert error_of(reference) == message


def test_methods_that_look_like_missing_ones_are_named(folder: Any, error_of: Any) -> None:
    half = "from protocols import Mobile, Half\nclass Slips(Half):\n"
    methods = ("initialise", "handle_packets", "handle_telemetry", "on_timer", "finish")
    folder.write("slips.py", half + "".join(f"    def {name}(self, *_): ...\n" for name in methods))
    lacks = "handle_packet(), handle_timer()"
    assert error_of("slips.py:Slips") == (
        f"`Slips` in slips.py is not complete, it lacks {lacks}; it has handle_packets()"
    )


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
    shown = error_of("broken.py:Mobile")
    assert re.fullmatch(rf"broken\.py does not load: {re.escape(error)}.* \(broken\.py:{line}\)", shown)


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
def test_the_form_of_a_reference_is_told_where_it_leads_to_no_file(
    folder: Any, reference: str, is_form: bool
) -> None:
    folder.write("broken.py", "def f(:")
    error = folder.error(f'*.boat.protocol.class = "{reference}"\n')
    assert ('expected a protocol as "file.py:Class" or "package.module:Class"' in error) is is_form
    assert ("expected" in error) is is_form


@pytest.mark.parametrize(
    ("name", "problem"), [("p" * 5000, "File name too long"), ("p\0", "there is no file p\0.py")]
)
def test_a_name_that_no_file_has_is_an_error(error_of: Any, name: str, problem: str) -> None:
    assert problem in error_of(f"{name}.py:Mobile")


def test_an_error_in_a_sibling_shows_the_siblings_line(folder: Any, error_of: Any) -> None:
    folder.write("broken.py", "import sibling_x")
    folder.write("sibling_x.py", "\n\n1 / 0")
    assert error_of("broken.py:Mobile") == (
        "broken.py does not load: ZeroDivisionError: division by zero (sibling_x.py:3)"
    )


def test_a_callback_that_cannot_be_called_is_refused_with_its_line(folder: Any) -> None:
    folder.write(
        "wrong.py", "from protocols import Sensor\n\nclass Wrong(Sensor):\n    def handle_timer(self): pass\n"
    )
    error = folder.error('[X]\n*.uavs[1].protocol.class = "wrong.py:Wrong"\n', "X")
    assert error.startswith(
        'test.ini:7: *.uavs[1].protocol.class = "wrong.py:Wrong": `handle_timer(self)` of `Wrong` ('
    )
    assert error.endswith(
        "wrong.py:4) cannot be called with `timer` alone; expected `def handle_timer(self, timer)`"
    )


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
    assert str(caught.value).replace(f"{folder.path}/", "") == (
        'own.ini:3: *.uav.protocol.class = "own.py:Mine": own.py is being loaded already: it reads this'
        ' configuration when it is imported (own.py:9); expected that below `if __name__ == "__main__":`'
    )


def test_a_script_that_runs_its_own_class_is_told_both_ways(
    folder: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder.write("own.ini", OWN_INI)
    script = folder.write("own.py", OWN.format(""))
    monkeypatch.setattr(sys.modules["__main__"], "__file__", str(script), raising=False)
    with pytest.raises(ConfigError, match=r"or the class as `__main__:Class`$"):
        load_scenarios(folder.path / "own.ini")


def test_a_file_that_was_loaded_by_itself_loads_once_it_is_mended(folder: Any) -> None:
    folder.write("own.ini", OWN_INI)
    folder.write("own.py", OWN.format(""))
    with pytest.raises(ConfigError):
        load_scenarios(folder.path / "own.ini")
    folder.write("own.py", OWN.format('if __name__ == "__main__": '))
    assert load_scenarios(folder.path / "own.ini")[0].nodes[0].protocol.__name__ == "Mine"
