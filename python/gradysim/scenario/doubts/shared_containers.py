"""`heard = []` in the body of a class is one list for all nodes, and `self.heard.append(...)` goes into it.

In reality nodes share nothing, and so a protocol that works thanks to such a list works in simulations only.
Whether methods change it is found in the text of the protocol's classes, before anything runs; where one of
them gives the node a value of its own, `self.heard = []`, nothing is told, nor of what is changed by the name
of the class, `Hello.heard.append(...)`: that says what it does.
"""

import ast
from collections import deque
from collections.abc import Iterable, Iterator, MutableMapping, MutableSequence, MutableSet

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.doubts.protocol_code import code_of
from gradysim.scenario.node.node_spec import NodeSpec
from gradysim.scenario.protocol.kept_with_class import kept_with_class

_CONTAINERS = (MutableSequence, MutableMapping, MutableSet, deque)

_CHANGES = frozenset(
    {"append", "extend", "insert", "remove", "reverse", "sort", "pop", "clear"}
    | {"appendleft", "extendleft", "popleft", "rotate", "update", "setdefault", "popitem", "add", "discard"}
    | {"difference_update", "intersection_update", "symmetric_difference_update"}
)
"""Methods that change what they belong to."""


def shared_containers(nodes: Iterable[NodeSpec]) -> Iterator[str]:
    """Yield one line of text for each that several nodes share, "FILE:LINE: warning: ..."."""
    first: dict[tuple[type, str], NodeSpec] = {}
    told: set[tuple[type, str]] = set()
    for spec in nodes:
        for name in _changed_by_nodes(spec.protocol):
            owner = next(cls for cls in spec.protocol.__mro__ if name in vars(cls))
            one = first.setdefault((owner, name), spec)
            if one is spec or (owner, name) in told:
                continue
            told.add((owner, name))
            kind = type(vars(owner)[name]).__name__
            yield (
                f"{one.protocol_sources.get('', owner.__module__)}: warning: `{name}` in the body of"
                f" {owner.__name__} is one {kind} for all nodes, and `self.{name}` changes it for all;"
                f" expected `self.{name} = ...` in `initialize`, or, if they are meant to share it,"
                f" `{owner.__name__}.{name}` where it changes"
            )


@kept_with_class
def _changed_by_nodes(protocol: type[IProtocol]) -> tuple[str, ...]:
    """The names of containers in class bodies that some method changes through `self`, and none sets anew."""
    code = code_of(protocol)
    extended = {id(node.target) for node in code if isinstance(node, ast.AugAssign)}
    own = {name for node in code if id(node) not in extended and (name := _of_self(node, ast.Store))}
    changed = dict.fromkeys(name for node in code if (name := _changed(node)))
    return tuple(name for name in changed if name not in own and _is_container(protocol, name))


def _changed(node: ast.AST) -> str:
    """`heard`, if it is `self.heard.append(...)`, `self.heard[...] = ...`, `del self.heard[...]` or `+=`."""
    match node:
        case ast.Call(func=ast.Attribute(value=container, attr=method)) if method in _CHANGES:
            return _of_self(container, ast.Load)
        case ast.Subscript(value=container, ctx=ast.Store() | ast.Del()):
            return _of_self(container, ast.Load)
        case ast.AugAssign(target=container):
            return _of_self(container, ast.Store)
    return ""


def _of_self(node: ast.AST, context: type[ast.expr_context]) -> str:
    match node:
        case ast.Attribute(value=ast.Name(id="self"), attr=name, ctx=ctx) if isinstance(ctx, context):
            return name
    return ""


def _is_container(protocol: type[IProtocol], name: str) -> bool:
    owner = next((cls for cls in protocol.__mro__ if name in vars(cls)), None)
    return owner is not None and isinstance(vars(owner)[name], _CONTAINERS)
