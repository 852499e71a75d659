"""One file of JSON per run: DIR/CONFIG-#RUN.MODE.json."""

import json
import os
from pathlib import Path

from gradysim.results.run_result import RunResult


def write_run_file(result: RunResult, directory: Path) -> Path:
    """Write `result` into `directory`, which is made when missing, and return the file's path.

    An earlier file of the same configuration, run and mode is replaced, by the whole of this one or not at
    all: others may read it, or write it too. Raises OSError, with the name of the file, when it cannot be
    written.
    """
    directory.mkdir(parents=True, exist_ok=True)
    path = directory / f"{result.config}-#{result.run}.{result.mode}.json"
    unfinished = path.with_name(f"{path.name}.{os.getpid()}")
    try:
        unfinished.write_text(json.dumps(result.to_json_object(), indent=2) + "\n", encoding="utf-8")
        unfinished.replace(path)
    except BaseException as error:
        unfinished.unlink(missing_ok=True)
        if isinstance(error, OSError):
            error.filename = str(path)  # which a full disk does not say
        raise
    return path
