"""The text of protocols, for doubts about what they will do: nothing of it is run."""

import ast
import inspect
import textwrap

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.protocol.kept_with_class import kept_with_class
from gradysim.scenario.protocol.python_text import parsed_python


@kept_with_class
def code_of(protocol: type[IProtocol]) -> tuple[ast.AST, ...]:
    """All that stands in a class and its bases, but for those of gradysim; nothing of one without a text."""
    return tuple(node for cls in protocol.__mro__ for node in _code(cls))


def called_name(call: ast.Call) -> str:
    """The last name of what is called: "Plugin" for `Plugin(self)` and `module.Plugin(self)`."""
    match call.func:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name
    return ""


def _code(cls: type) -> list[ast.AST]:
    if cls.__module__.partition(".")[0] in ("gradysim", "builtins", "abc"):
        return []
    try:
        tree = parsed_python(textwrap.dedent(inspect.getsource(cls)))
    except (OSError, TypeError, SyntaxError):  # there is no text of it
        return []
    return list(ast.walk(tree))
