"""The models that a run chooses, and the lines that nothing reads because another model is chosen."""

from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple

from gradysim.scenario.resolve.lines import Row
from gradysim.scenario.resolve.resolution import Resolution
from gradysim.scenario.schema.engine_keys import Key, ReadBy
from gradysim.scenario.schema.keys import (
    IEEE802154_INTERFACE,
    KEYS_BY_TARGET,
    NETWORK_KEYS,
    OF_802154,
    at_interface,
    index_of_interface,
)
from gradysim.scenario.schema.values import SettingReader

Chosen = Callable[[str], str | None]
"""Maps the target of a key that chooses a model to the model, written or by default.

None if the file chooses none, by `typename = ""`. The parameters of that model are not reported.
"""

_OF_NETWORK = frozenset(key.target for key in NETWORK_KEYS)


def unmet_choice(target: str, chosen: Chosen) -> ReadBy | None:
    """Return what must be chosen for the key with this target to be read; None if it is read."""
    read_by = KEYS_BY_TARGET[target].read_by if target in KEYS_BY_TARGET else None
    if read_by is None:
        return None
    outer = unmet_choice(read_by.chosen_by, chosen)
    if outer is not None:
        return outer
    return None if chosen(read_by.chosen_by) in (*read_by.names, None) else read_by


class RowOfSubject(NamedTuple):
    """A row, with what is chosen where it is.

    Attributes:
        row: The row.
        target: The target of its key; that of another key where an interface of 802.15.4 reads that instead.
        node: The first node that it is about, or "" for the network.
        chosen: The models there.
    """

    row: Row
    target: str
    node: str
    chosen: Chosen


class Models:
    """The models that a run chooses."""

    def __init__(self, resolution: Resolution, settings: SettingReader) -> None:
        """Read the lines in force with `settings`, which has the seed of the run."""
        self._resolution = resolution
        self._settings = settings

    def rows(self) -> Iterator[RowOfSubject]:
        """Yield the rows of the network, and those of one node of each kind."""
        of_network = self._resolution.of_network
        yield from self._placed(of_network.values(), "")
        seen = set()
        for node, kind in self._resolution.kinds.items():
            if kind not in seen:
                seen.add(kind)
                yield from self._placed(kind.rows.values(), node)

    def _placed(self, rows: Iterable[Row], node: str) -> Iterator[RowOfSubject]:
        for row in rows:
            yield self.placed(row, node)

    def placed(self, row: Row, node: str) -> RowOfSubject:
        """Return a row of a node, or of the network, with what is chosen there."""
        index = index_of_interface(row.path)

        def chosen(target: str) -> str | None:
            return self.chosen(target, node, index)

        key = row.key
        if key in OF_802154 and chosen("interface.typename") == IEEE802154_INTERFACE:
            key = OF_802154[key]
        return RowOfSubject(row, key.target, node, chosen)

    def chosen(self, target: str, node: str = "", interface: int = 0) -> str | None:
        """Return the model that is chosen for a node, or for the network, by the key with that target."""
        key = KEYS_BY_TARGET[target]
        if target in _OF_NETWORK:
            row = self._resolution.of_network.get(key.path)
        else:
            row = self._resolution.kinds[node].rows.get(at_interface(key.path, interface))
        if row is None or row.line.is_default:
            return str(self.default(key, node, interface))
        return (
            str(self._settings.scalar(row.line.entry, key.kind, f"{node}.{row.path}" if node else "")) or None
        )

    def default(self, key: Key, node: str, interface: int = 0) -> Any:
        """Return the default of a key, which may be another one for 802.15.4."""
        if not key.defaults:
            return key.default.strip('"')
        chooser = f"{'medium' if key.target in _OF_NETWORK else 'interface'}.typename"
        if key.target == chooser:
            return key.defaults[""]
        variants, chosen = KEYS_BY_TARGET[chooser].defaults, self.chosen(chooser, node, interface)
        return key.defaults[next((name for name in key.defaults if name and variants[name] == chosen), "")]
