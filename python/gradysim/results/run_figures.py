"""What means over runs are made of, of one run: a result has all its nodes, and a study many results."""

import hashlib
import json
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from gradysim.results.shares import mean_delays, shares
from gradysim.results.student import mean_of
from gradysim.results.tracked_numbers import Tracked, numbers_and_others, numeric_variables, tracked_by_group


@dataclass(frozen=True)
class TrackedVariable:
    """A tracked variable at the nodes of a group.

    Attributes:
        mean: Of the finite numbers; None if it is one at no node.
        others: What it is at how many of the other nodes.
    """

    mean: float | None
    others: Mapping[str, int]


@dataclass(frozen=True)
class GroupFigures:
    """The tracked variables of a group."""

    node_count: int
    variables: Mapping[str, TrackedVariable]

    @classmethod
    def of(cls, nodes: list[Tracked]) -> "GroupFigures":
        """Return those of its nodes."""
        variables = {}
        for name in dict.fromkeys(name for tracked in nodes for name in tracked):
            numbers, others = numbers_and_others(nodes, name)
            variables[name] = TrackedVariable(mean_of(numbers) if numbers else None, Counter(others))
        return cls(len(nodes), variables)

    def variable(self, name: str) -> TrackedVariable:
        """Return one of them, which may be missing at all nodes of this run."""
        return self.variables.get(name) or TrackedVariable(None, {"missing": self.node_count})


@dataclass(frozen=True)
class RunFigures:
    """One run.

    Attributes:
        computed: A hash of all that it computed.
        numeric_variables: (group, name) of those that are a number, if only an infinite one, at any node.
        figures: Shares of messages and frames, and the mean delays of messages.
    """

    config: str
    mode: str
    run: int
    iterations: Mapping[str, object]
    seed: object
    settings_hash: object
    file_hashes: Mapping[str, str]
    computed: str
    groups: Mapping[str, GroupFigures]
    numeric_variables: tuple[tuple[str, str], ...]
    figures: Mapping[str, float]

    @classmethod
    def of(cls, result: Mapping[str, Any]) -> "RunFigures":
        """Return those of a result, as its file has it."""
        hashes = result.get("file_hashes")
        tracked = tracked_by_group(result["nodes"])
        delays = mean_delays(result.get("message_delays") or {})
        return cls(
            result["config"],
            result["mode"],
            result["run"],
            result["iterations"],
            result.get("seed"),
            result.get("settings_hash"),
            hashes if isinstance(hashes, dict) else {},
            _hash([result.get(field) for field in ("fingerprint", "fates", "nodes")]),
            {group: GroupFigures.of(nodes) for group, nodes in tracked.items()},
            tuple(numeric_variables(tracked)),
            {**dict(shares(result["fates"])), **delays},
        )

    @property
    def values(self) -> str:
        """What runs have in common over which means are made."""
        return json.dumps([self.config, self.mode, self.iterations], sort_keys=True)


def _hash(content: object) -> str:
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()
