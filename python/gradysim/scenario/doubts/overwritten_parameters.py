"""`protocol.period = 3s` for a protocol whose `initialize` says `self.period = 1.0`: the line has no effect.

That nothing can have seen the value by then is found in the text of the protocol's classes, before anything
runs. Where something before may have, as a method that is called or `self.period = 2 * self.period`, nothing
is told.
"""

import ast
from collections.abc import Iterable, Iterator, Sequence

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.doubts.protocol_code import code_of
from gradysim.scenario.errors import Source
from gradysim.scenario.node.node_spec import NodeSpec
from gradysim.scenario.protocol.kept_with_class import kept_with_class

_FIRST = ("__init__", "initialize")
"""What a protocol does before all else, in this order."""


def overwritten_parameters(nodes: Iterable[NodeSpec]) -> Iterator[str]:
    """Yield one line of text for each parameter that the protocol sets itself, "FILE:LINE: warning: ..."."""
    told: set[tuple[Source, type[IProtocol]]] = set()
    for spec in nodes:
        overwritten = _overwritten(spec.protocol)
        for name, source in spec.protocol_sources.items():
            if name in overwritten and (source, spec.protocol) not in told:
                told.add((source, spec.protocol))
                yield (
                    f"{source}: warning: it has no effect: `{overwritten[name]}` of {spec.protocol.__name__}"
                    f" sets `self.{name}` before anything reads it; expected the default in the body of the"
                    f" class alone, `{name} = ...`"
                )


@kept_with_class
def _overwritten(protocol: type[IProtocol]) -> dict[str, str]:
    """Return {parameter: the method that sets it}."""
    code = code_of(protocol)
    found: dict[str, str] = {}
    read: set[str] = set()
    for method in _FIRST:
        # That of the class itself comes before those of its bases, which run only if it calls them.
        function = next((f for f in code if isinstance(f, ast.FunctionDef) and f.name == method), None)
        for statement in [] if function is None else function.body:
            parts = list(ast.walk(statement))
            if _may_read_all(parts):
                return found
            read.update(name for part in parts if (name := _read(part)))
            for name in _set_by(statement) - read:
                found.setdefault(name, method)
    return found


def _may_read_all(parts: Sequence[ast.AST]) -> bool:
    """Whether a method is called, or the protocol given to something else, as in `Plugin(self)`."""
    of_attributes = {id(part.value) for part in parts if isinstance(part, ast.Attribute)}
    for part in parts:
        match part:
            case ast.Call(func=ast.Attribute(value=ast.Name(id="self"))) | ast.Name(id="super"):
                return True
            case ast.Name(id="self") if id(part) not in of_attributes:
                return True
    return False


def _read(part: ast.AST) -> str:
    """`period`, for `self.period`, `Hello.period`, `self.period += 1` and the text "period"."""
    match part:
        case ast.Attribute(attr=name, ctx=ast.Load()) | ast.AugAssign(target=ast.Attribute(attr=name)):
            return name
        case ast.Constant(value=str(name)):
            return name
    return ""


def _set_by(statement: ast.stmt) -> set[str]:
    """`period`, for `self.period = ...`."""
    match statement:
        case ast.Assign(targets=targets):
            pass
        case ast.AnnAssign(target=target, value=ast.expr()):
            targets = [target]
        case _:
            return set()
    return {
        target.attr
        for target in targets
        if isinstance(target, ast.Attribute)
        and isinstance(target.value, ast.Name)
        and target.value.id == "self"
    }
