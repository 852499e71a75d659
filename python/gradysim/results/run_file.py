"""One file of JSON per run: DIR/CONFIG-#RUN.MODE.json."""

import json
from pathlib import Path

from gradysim.results.run_result import RunResult


def write_run_file(result: RunResult, directory: Path) -> Path:
    """Write `result` into `directory`, which is made when missing, and return the file's path.

    An earlier file of the same configuration, run and mode is replaced. Raises OSError when it cannot be
    written.
    """
    directory.mkdir(parents=True, exist_ok=True)
    path = directory / f"{result.config}-#{result.run}.{result.mode}.json"
    path.write_text(json.dumps(result.to_json_object(), indent=2) + "\n", encoding="utf-8")
    return path
