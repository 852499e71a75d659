"""Lines of a scenario that no model reads: the parameters of one that was not chosen.

OMNeT++ takes them without a word, and so may a file that is shared with it; but who writes such a line mostly
believes that it does something. What reads a key stands in the tables of keys. A line counts as read as soon
as one node, or the network, reads it in one run of a study: a line with wildcards is meant for those who have
what it is about.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from gradysim.scenario.errors import Source
from gradysim.scenario.keys import NETWORK_KEYS, NODE_KEYS
from gradysim.scenario.keys.interface import written_for
from gradysim.scenario.keys.key import ReadBy
from gradysim.scenario.keys.radio import OF_802154

Chosen = Callable[[str], str | None]
"""Given the target of a key that chooses a model, returns the model, written or by default.

None if the file says on purpose that there is none, by `typename = ""`: its parameters are not reported.
"""

KEYS = {key.target: key for key in (*NODE_KEYS, *NETWORK_KEYS, *OF_802154.values())}

_CHOOSERS_OF_THE_NETWORK = frozenset(key.target for key in NETWORK_KEYS)
_MOST_LINES = 4
"""Lines that a message lists beside its own."""


def unmet_choice(target: str, chosen: Chosen) -> ReadBy | None:
    """What would have to be chosen for the key with this target to be read; None if it is read."""
    read_by = KEYS[target].read_by if target in KEYS else None
    if read_by is None:
        return None
    further_out = unmet_choice(read_by.chosen_by, chosen)
    if further_out is not None:
        return further_out
    return None if chosen(read_by.chosen_by) in (*read_by.names, None) else read_by


@dataclass
class _Unread:
    """Why a line is not read: what would have to be chosen, for whom, and what is chosen there."""

    choice: ReadBy
    whose: str
    chosen: set[str] = field(default_factory=set)


class UnreadLines:
    """Collects which lines are read and which are not, from all that they are in force for."""

    def __init__(self) -> None:
        self._read: set[Source] = set()
        self._unread: dict[Source, _Unread] = {}

    def add(self, sources: Mapping[str, Source], chosen: Chosen, node: str = "") -> None:
        """Take the lines that are in force for one node, or for the network, by the targets of their keys.

        `node` is the node, or its group, as people write it: "uavs[*]".
        """
        for target, source in sources.items():
            choice = unmet_choice(target, chosen)
            if choice is None:
                self._read.add(source)
                continue
            whose = "*." if choice.chosen_by in _CHOOSERS_OF_THE_NETWORK else f"*.{node}."
            unread = self._unread.setdefault(source, _Unread(choice, whose))
            if unread.choice == choice:
                unread.chosen.add(chosen(choice.chosen_by) or "")

    def texts(self) -> Iterator[str]:
        """One text for the lines that lack the same choice, in the order of the files."""
        alike: dict[tuple[str, ReadBy, frozenset[str]], list[Source]] = {}
        unread_sources = self._unread.keys() - self._read
        for source in sorted(unread_sources, key=lambda source: (source.file, source.line, source.key)):
            unread = self._unread[source]
            choice = unread.choice
            key = unread.whose + written_for(KEYS[choice.chosen_by].written, source.key)
            alike.setdefault((key, choice, frozenset(unread.chosen)), []).append(source)
        for (key, choice, chosen), sources in alike.items():
            first, *others = sources
            yield (
                f"{first}: warning: nothing reads `{first.key}`{_nor(first, others)}: that takes"
                f" `{key} = {_either(choice.names)}`, and it is {_either(sorted(chosen))}"
            )


def _nor(first: Source, others: list[Source]) -> str:
    if not others:
        return ""
    if len(others) > _MOST_LINES:
        return f", nor {len(others)} other lines"
    places = [str(other.line) if other.line and other.file == first.file else str(other) for other in others]
    lines = "line" if len(places) == 1 else "lines"
    return f", nor {lines} {_joined(places, 'and')}"


def _either(names: Iterable[str]) -> str:
    return _joined([f'"{name}"' for name in names], "or")


def _joined(texts: list[str], word: str) -> str:
    return f" {word} ".join([*([", ".join(texts[:-1])] if texts[1:] else []), texts[-1]])
