"""Finds the groups of nodes of a configuration, and the number of nodes of each.

`*.numUavs = 2` or `*.uavs.count = 2` makes uavs[0] and uavs[1]. A name without a count is a single node
without an index, if its protocol is given by that name: `*.groundStation.protocol.class = ...`. Groups are
ordered by the first line that names them: [General] first, then the bases from the last to the first, the own
section and the command line. This is the order of node ids.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from gradysim.scenario.errors import ErrorCollector
from gradysim.scenario.parse.patterns import Pattern, compile_pattern
from gradysim.scenario.resolve.lines import Line, Lines, Row, Schema
from gradysim.scenario.schema.keys import GROUP_SIZE, NETWORK_MODULES, NUM_WLAN_INTERFACES, PROTOCOL_KEYS
from gradysim.scenario.schema.options import IGNORED_MODULES
from gradysim.scenario.schema.values import SettingReader

_PROTOCOL_PATHS = frozenset(key.path for key in PROTOCOL_KEYS)

_SIZE = Schema({"": GROUP_SIZE})
"""Of `numUavs`, which is below the network."""
_COUNT = Schema({GROUP_SIZE.path: GROUP_SIZE})
"""Of `uavs`, in `uavs.count`."""


@dataclass(frozen=True)
class Group:
    """Nodes of one name.

    Attributes:
        name: The name without an index.
        size: The number of nodes, or None for a single node without an index.
        size_row: The lines that set the number, by both keys; None without any.
        size_key: The key below the network that sets the size: "numUavs".
        has_wrong_size: Whether that number is wrong, and the size 1 stands for it.
    """

    name: str
    size: int | None
    size_row: Row | None
    size_key: str
    has_wrong_size: bool = False

    @property
    def size_line(self) -> Line | None:
        """The line that sets the number; None for a single node."""
        return self.size_row.line if self.size_row is not None and self.size is not None else None

    def node_names(self) -> list[str]:
        """Return the names of the nodes by index."""
        return [self.name] if self.size is None else [f"{self.name}[{index}]" for index in range(self.size)]

    @property
    def written(self) -> str:
        """The name in a pattern for all nodes of the group: "uavs[*]"."""
        return self.name if self.size is None else f"{self.name}[*]"


def find_groups(lines: Lines, settings: SettingReader, errors: ErrorCollector) -> list[Group]:
    """Return all groups, in the order of their node ids. `errors` takes the errors of numbers of nodes."""
    mentions = _Mentions(sorted(lines.all, key=lambda line: (-line.entry.rank, line.order)))
    groups = []
    for name, size_key in mentions.size_keys().items():
        rows = [
            *lines.rows(lines.names(size_key), _SIZE).values(),
            *lines.rows(lines.names(name), _COUNT).values(),
        ]
        of_size = sorted({line for row in rows for line in row.lines}, key=lambda line: line.order)
        row = Row(GROUP_SIZE, f"{name}.{GROUP_SIZE.path}", tuple(of_size)) if of_size else None
        if row is not None and not row.line.is_default:
            size = None
            with errors.collecting():
                size = int(settings.scalar(row.line.entry, GROUP_SIZE.kind, row.path))
            groups.append(Group(name, 1 if size is None else size, row, size_key, size is None))
        elif name in mentions.with_class:
            groups.append(Group(name, None, row, size_key))
    return groups


class _Mentions:
    """The names that entries mention literally, in the order of the entries."""

    def __init__(self, lines: Iterable[Line]) -> None:
        self.with_class: set[str] = set()
        self._with_protocol: set[str] = set()  # with an index, too
        self._names: dict[str, None] = {}  # a set that keeps its order; holds "num..." keys as well
        for line in lines:
            name, rest = _name_and_rest(line)
            if name is None or name in NETWORK_MODULES or name in IGNORED_MODULES:
                continue
            if rest is None and not _is_size_key(name):
                continue
            self._names.setdefault(name)
            if rest in _PROTOCOL_PATHS:
                self._with_protocol.add(name)
                if _names_single(line):
                    self.with_class.add(name)

    def size_keys(self) -> dict[str, str]:
        """Return {name of a group: the key that sets its size}.

        `*.numUavs` is for one group: of several that differ only in case, the first one with a protocol.
        """
        groups = [name for name in self._names if not _is_size_key(name)]
        groups.sort(key=lambda name: name not in self._with_protocol)
        by_folded = {name.casefold(): name for name in reversed(groups)}
        taken = {name[3:].casefold() for name in self._names if _is_size_key(name)}
        result: dict[str, str] = {}
        for name in self._names:
            folded = name.casefold()
            if _is_size_key(name):
                group = by_folded.get(folded[3:], name[3].lower() + name[4:])
                result[group] = name
            elif folded in taken and by_folded[folded] != name:
                result[name] = f"{name}.{GROUP_SIZE.path}"
            else:
                result.setdefault(name, f"num{name[0].upper()}{name[1:]}")
        return result


def _names_single(line: Line) -> bool:
    """Return whether the line's name below the network has no index."""
    return "[" not in _below_network(line)[0].text


def _is_size_key(name: str) -> bool:
    return name.startswith("num") and name[3:4].isupper() and name != NUM_WLAN_INTERFACES.path


def _name_and_rest(line: Line) -> tuple[str | None, str | None]:
    """Return the group that a line names literally, or None, and its literal rest, or None."""
    name, *rest = _below_network(line)
    group, bracket, _ = name.literal_prefix().partition("[")
    if not group or not (bracket or name.literal):
        return None, None
    return group, (rest[0].literal or rest[0].text) if rest else None


def _below_network(line: Line) -> list[Pattern]:
    """Return the parts below the network; `**.` at the start stands for the network here."""
    if line.parts is None and line.entry.key.startswith("**."):
        below = compile_pattern(f"*.{line.entry.key[3:]}").split()
        return below[1:] if below else [Pattern(())]
    return line.parts[1:] if line.parts else [Pattern(())]
