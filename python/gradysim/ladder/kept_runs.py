"""Runs of a campaign that are kept on the disk, so that a command that is stopped can continue.

The file has a line for each run: a checksum, what identifies the run, and what it showed. Lines are only
added. A run is identified by its settings, its seed, the files that it reads, and the delay of its timers, so
that other commands and other metrics find it, too. A line that is cut or damaged counts as missing.
"""

import hashlib
import json
import os
from collections.abc import Collection, Iterator, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any, Self

from gradysim.ladder.failure import Failure
from gradysim.ladder.jitter import Jitter
from gradysim.ladder.observation import Observation
from gradysim.scenario.scenario import Scenario

_DIGITS = 16


class KeptRuns:
    """The runs in the file `CONFIG.runs.jsonl` of a directory.

    Attributes:
        path: The file.
    """

    def __init__(self, directory: Path, config: str, *, resume: bool = False) -> None:
        """Open the file. With `resume`, the runs in it count as done. Raises OSError."""
        directory.mkdir(parents=True, exist_ok=True)
        self.path = directory / f"{config}.runs.jsonl"
        self._known: dict[str, Observation] = {}
        if resume and self.path.exists():
            self._known = dict(_read(self.path))
        self._file = self.path.open("a", encoding="utf-8")
        if self.path.stat().st_size:
            self._file.write("\n")  # after a line that was cut

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()

    def find(
        self, scenario: Scenario, jitter: Jitter | None, quantities: Collection[str] = ()
    ) -> Observation | None:
        """Return what a run showed; None if it has not been done, or does not tell these quantities."""
        seen = self._known.get(_key(scenario, jitter))
        return seen if seen is not None and seen.has(quantities) else None

    def add(self, scenario: Scenario, jitter: Jitter | None, seen: Observation) -> None:
        """Keep what a run showed. Raises OSError."""
        content = json.dumps([_key(scenario, jitter), asdict(seen)], separators=(",", ":"))
        self._file.write(f"{_checksum(content)} {content}\n")
        self._file.flush()
        os.fsync(self._file.fileno())


def _read(path: Path) -> Iterator[tuple[str, Observation]]:
    with path.open(encoding="utf-8", errors="replace") as lines:
        for line in lines:
            checksum, _, content = line.rstrip("\n").partition(" ")
            if content and checksum == _checksum(content):
                key, seen = json.loads(content)
                yield key, _observation(seen)


def _observation(plain: Mapping[str, Any]) -> Observation:
    failure = plain["failure"]
    known = {"binary": tuple(plain["binary"]), "failure": None if failure is None else Failure(**failure)}
    return Observation(**{**plain, **known})


def _key(scenario: Scenario, jitter: Jitter | None) -> str:
    delayed = None if jitter is None else [sorted(jitter.timers), jitter.longest_s]
    identity = [scenario.settings_hash, scenario.seed, sorted(scenario.file_hashes.items()), delayed]
    return hashlib.sha256(json.dumps(identity).encode()).hexdigest()[:_DIGITS]


def _checksum(content: str) -> str:
    return hashlib.sha256(content.encode()).hexdigest()[:_DIGITS]
