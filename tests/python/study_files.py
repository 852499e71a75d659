"""Files of a study, written by hand."""

import json
from array import array
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from gradysim.results.omnetpp import RunIdentity, write_vector_file
from gradysim.results.recorder import Vector

SECOND_PS = 10**12


def write_result(directory: Path, run: int = 0, heard: Iterable[object] = (1, 3), **changes: Any) -> Path:
    """Write the result of a run with a node `uavs[i]` for each value of the variable `heard`."""
    nodes = [
        {"name": f"uavs[{i}]", "position": [10.0 * i, 0.0, 5.0], "tracked_variables": {"heard": value}}
        for i, value in enumerate(heard)
    ]
    result = {
        "config": "Study",
        "mode": "integrated",
        "run": run,
        "seed": run,
        "sim_time_s": 10.0,
        "interrupted": False,
        "iterations": {},
        "outcomes": {},
        "nodes": nodes,
        "settings_hash": "a",
        **changes,
    }
    directory.mkdir(exist_ok=True)
    file = directory / f"{result['config']}-#{run}.{result['mode']}.json"
    file.write_text(json.dumps(result))
    return file


def write_vectors(result: Path, vectors: Mapping[tuple[str, str, str], Mapping[float, float]]) -> None:
    """Write the `.vec` file of a run: {(node, part, name): {time in s: value}}."""
    written = [
        (
            f"Network.{node}.{part}",
            Vector(
                part,
                name,
                array("q", [round(time_s * SECOND_PS) for time_s in values]),
                array("d", values.values()),
            ),
        )
        for (node, part, name), values in vectors.items()
    ]
    write_vector_file(written, RunIdentity("A-0", {}, {}, ()), result.with_suffix(".vec"))
