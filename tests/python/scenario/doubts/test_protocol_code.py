import ast
from typing import Any

import pytest

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.doubts.protocol_code import called_name, code_of


def names_in(folder: Any, text: str) -> set[str]:
    folder.write("own.py", text)
    protocol = folder.load('[X]\n*.uavs[*].protocol.class = "own.py:Own"\n', "X").nodes[1].protocol
    return {node.id for node in code_of(protocol) if isinstance(node, ast.Name)}


def test_the_text_of_a_class_and_its_bases(folder: Any) -> None:
    base = "from protocols import Sensor\nclass Base(Sensor):\n    of_base = 1\n"
    names = names_in(
        folder, f"{base}class Own(Base):\n    of_own = 2\nclass Other(Base):\n    of_other = 3\n"
    )
    assert {"of_base", "of_own"} <= names
    assert "of_other" not in names


def test_of_a_class_without_a_text_nothing_is_known() -> None:
    assert code_of(type("Made", (IProtocol,), {})) == ()


@pytest.mark.parametrize("call", ["Plugin(self)", "module.Plugin(self)", "a.b.Plugin()"])
def test_the_last_name_of_what_is_called(call: str) -> None:
    (statement,) = ast.parse(call).body
    assert isinstance(statement, ast.Expr)
    assert isinstance(statement.value, ast.Call)
    assert called_name(statement.value) == "Plugin"


def test_what_has_no_name() -> None:
    (statement,) = ast.parse("plugins[0]()").body
    assert isinstance(statement, ast.Expr)
    assert isinstance(statement.value, ast.Call)
    assert called_name(statement.value) == ""
