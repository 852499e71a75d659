"""What NED files declare: networks with the radio medium, the nodes with their numbers, types and positions.

Only declarations of this form are read: `name[size]: Type`, `name: <default("Type")> like ...`,
`int size = default(2)` and `@display("p=100,200")`.
"""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from gradysim.omnetpp_import.tables import GRADYS_NETWORK, NODE_TYPES

_COMMENT = re.compile(r'("(?:[^"\\\n]|\\.)*")|//[^\n]*')
_HEADING = re.compile(r"\b(network|module)\s+(\w+)(?:\s+extends\s+([\w.]+))?[^{;]*\{")
_SUBMODULE = re.compile(
    r"\b(?!(?:types|parameters|submodules|gates|connections)\b)"
    r'(\w+)\s*(?:\[\s*([^\]]*?)\s*\])?\s*:\s*(?:<\s*default\(\s*"([\w.]*)"\s*\)[^>]*>\s*like\s+\w+|([\w.]+))'
    r"[^;{]*(?:\{|;)"
)
_PARAMETER = re.compile(r"\bint\s+(\w+)\s*=\s*(?:default\(\s*)?(\d+)")
_POSITION = re.compile(r'@display\(\s*"[^"]*?\bp=(-?[\d.]+),(-?[\d.]+)(?=[;"])')


@dataclass(frozen=True)
class NedNode:
    """A submodule that is a node, or a vector of them.

    Attributes:
        name: Its name.
        size: The parameter or number of a vector; "" for a single node.
        type: A key of `NODE_TYPES`.
        position: x and y of its display string in meters, or None.
    """

    name: str
    size: str
    type: str
    position: tuple[str, str] | None = None

    @property
    def written(self) -> str:
        """The name in a pattern for all of them."""
        return f"{self.name}[*]" if self.size else self.name

    @property
    def first(self) -> str:
        """The name of one of them."""
        return f"{self.name}[0]" if self.size else self.name

    @property
    def size_key(self) -> str:
        """The key that sets their number here."""
        return f"num{self.name[0].upper()}{self.name[1:]}"


@dataclass(frozen=True)
class NedNetwork:
    """A network.

    Attributes:
        source: The NED file, for messages.
        medium: Type of the radio medium; "" if there is none.
        nodes: Its nodes, in their order.
        sizes: {parameter: its default}.
    """

    source: str
    medium: str = ""
    nodes: tuple[NedNode, ...] = ()
    sizes: Mapping[str, str] = field(default_factory=dict)


def read_networks(folder: Path) -> dict[str, NedNetwork]:
    """Return the networks of all NED files of a directory, by name. Files that cannot be read are skipped."""
    bodies: dict[str, tuple[str, str, str, str]] = {}
    for source, text in _texts(folder):
        for kind, name, base, body in _modules(text):
            bodies[name] = (source, kind, base, body)
    types = _types(bodies)
    return {
        name: _network(name, bodies, types) for name, (_, kind, _, _) in bodies.items() if kind == "network"
    }


def _texts(folder: Path) -> Iterable[tuple[str, str]]:
    yield "GradysNetwork", GRADYS_NETWORK
    for file in sorted(folder.glob("*.ned")):
        try:
            yield file.name, _COMMENT.sub(r"\1", file.read_text(encoding="utf-8", errors="replace"))
        except OSError:
            continue


def _modules(text: str) -> Iterable[tuple[str, str, str, str]]:
    """Yield kind, name, base and body of each network or module at the top of a file."""
    position = 0
    while match := _HEADING.search(text, position):
        depth, position = 1, match.end()
        while position < len(text) and depth:
            depth += {"{": 1, "}": -1}.get(text[position], 0)
            position += 1
        yield match[1], match[2], (match[3] or "").rpartition(".")[2], text[match.end() : position]


def _types(bodies: Mapping[str, tuple[str, str, str, str]]) -> dict[str, str]:
    """Return {type of a submodule: the type in `NODE_TYPES` that it is or extends}."""
    types = {name: name for name in NODE_TYPES}
    for name in bodies:
        base, passed = name, set[str]()
        while base in bodies and base not in NODE_TYPES and base not in passed:
            passed.add(base)
            base = bodies[base][2]
        if base in NODE_TYPES:
            types[name] = base
    return types


def _network(
    name: str, bodies: Mapping[str, tuple[str, str, str, str]], types: Mapping[str, str]
) -> NedNetwork:
    source = bodies[name][0]
    medium, nodes, sizes = "", list[NedNode](), dict[str, str]()
    chain, passed = name, set[str]()
    while chain in bodies and chain not in passed:  # the network, then its bases
        passed.add(chain)
        _, _, base, body = bodies[chain]
        sizes = dict(_PARAMETER.findall(body)) | sizes
        matches = list(_SUBMODULE.finditer(body))
        for match, following in zip(matches, [*matches[1:], None], strict=True):
            kind = (match[3] or match[4] or "").rpartition(".")[2]
            if match[1] == "radioMedium":
                medium = medium or kind
            elif kind in types:
                within = body[match.end() : following.start() if following else len(body)]
                found = None if match[2] else _POSITION.search(within)
                nodes.append(
                    NedNode(match[1], match[2] or "", types[kind], (found[1], found[2]) if found else None)
                )
        chain = base
    return NedNetwork(source, medium, tuple(nodes), sizes)
