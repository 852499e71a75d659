"""Fingerprints and result hashes of the example configurations: their runs, and the file of hashes."""

import csv
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

from gradysim.integrated.run import run
from gradysim.scenario import load_scenarios
from gradysim.scenario.parse.ini import read_ini
from gradysim.scenario.parse.sections import config_names

ROOT = Path(__file__).resolve().parents[2]
KEPT = Path(__file__).with_name("fingerprints.csv")
SEEDS = (0, 1)
SIM_TIME_LIMIT = "600s"


class Hashes(NamedTuple):
    """What tells one run from another: of all events on the air and in the protocols, and of all results."""

    fingerprint: str | None
    result_hash: str


class Example(NamedTuple):
    """One run: a configuration, its seed and its duration (a quantity of an .ini file)."""

    file: str
    config: str
    seed: int
    sim_time_limit: str

    def hashes(self) -> Hashes:
        """Run it in integrated mode."""
        overrides = [f"seed-set = {self.seed}", f"sim-time-limit = {self.sim_time_limit}"]
        (scenario,) = load_scenarios(ROOT / self.file, self.config, runs=[0], overrides=overrides)
        result = run(scenario)
        return Hashes(result.fingerprint, result.result_hash)


def examples() -> Iterator[Example]:
    """Every configuration of the files in configs/, with each seed."""
    for file in sorted((ROOT / "configs").glob("*.ini")):
        for config in config_names(read_ini(file)):
            for seed in SEEDS:
                yield Example(file.relative_to(ROOT).as_posix(), config, seed, SIM_TIME_LIMIT)


def read() -> dict[Example, Hashes]:
    """Return the stored hashes."""
    with KEPT.open(encoding="utf-8", newline="") as lines:
        return {
            Example(row["file"], row["config"], int(row["seed"]), row["sim_time_limit"]): Hashes(
                row["fingerprint"], row["result_hash"]
            )
            for row in csv.DictReader(lines)
        }


def write(found: Iterable[tuple[Example, Hashes]]) -> None:
    """Store these hashes instead of the present ones."""
    with KEPT.open("w", encoding="utf-8", newline="") as lines:
        writer = csv.writer(lines, lineterminator="\n")
        writer.writerow([*Example._fields, *Hashes._fields])
        writer.writerows([*example, *hashes] for example, hashes in found)
