"""What a value may know of the parameter that it is for: the indices in its path, and draws of its own.

`parentIndex()`, `ancestorIndex(2)` and `index` are OMNeT++'s. Modules are the parts of a path before the last
one: in `uavs[3].mobility.speed` the module is `mobility`, its parent `uavs[3]`, so `parentIndex()` is 3.
"""

import re

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.drawing_functions import drawing_function_in
from gradysim.scenario.value.parameter_stream import ParameterStream
from gradysim.scenario.value.quoted import QUOTED

INDEX_FUNCTIONS = {"parentIndex": "parentIndex()", "ancestorIndex": "ancestorIndex(levels)"}
"""How they are written, by name."""

INDEX = "index"
"""The index of the module itself, which is no function."""

_INDEX_OR_TEXT = re.compile(
    rf"{QUOTED}|(\b(?:{'|'.join(INDEX_FUNCTIONS)})\s*\(|\b{INDEX}\b)", re.ASCII | re.DOTALL
)
_INDEX_IN_PATH = re.compile(r"\[(\d+)\]$", re.ASCII)


class ParameterContext:
    """One parameter, for one reading of its value.

    Attributes:
        seed: Of the run.
        path: Of the parameter, without the network.
        has_drawn: Whether a stream has been handed out.
    """

    def __init__(self, seed: int, path: str) -> None:
        """For the run with that seed."""
        self.seed = seed
        self.path = path
        self.has_drawn = False

    def stream(self, place: int) -> ParameterStream:
        """Return the stream of one of the draws that stand in the value, counted from the left, from 0."""
        self.has_drawn = True
        return ParameterStream(self.seed, self.path, place)

    def index_of_ancestor(self, levels: int) -> int:
        """The index of the module so many levels above that of the parameter.

        Raises:
            BadValue: There is none, or it has no index.
        """
        *modules, _ = self.path.split(".")
        if not 0 <= levels < len(modules):
            raise BadValue(
                f"there is no module {levels} levels above `{'.'.join(modules)}`", self._hint(modules)
            )
        module = modules[len(modules) - 1 - levels]
        match = _INDEX_IN_PATH.search(module)
        if match is None:
            raise BadValue(f"`{module}` in `{self.path}` has no index", self._hint(modules))
        return int(match[1])

    def _hint(self, modules: list[str]) -> str:
        """How the indices that there are, of the node and of its interface, are written there."""
        hints = []
        for levels, module in zip(reversed(range(len(modules))), modules, strict=True):
            if _INDEX_IN_PATH.search(module):
                written = (INDEX, "parentIndex()")[levels] if levels < 2 else f"ancestorIndex({levels})"
                hints.append(f"that of `{module}` is `{written}`")
        return f"; {', '.join(hints)}" if hints else ""


def differs_between_parameters(text: str) -> bool:
    """Whether a value draws or asks for an index, so that it is another one for each parameter."""
    return bool(drawing_function_in(text)) or any(match[1] for match in _INDEX_OR_TEXT.finditer(text))
