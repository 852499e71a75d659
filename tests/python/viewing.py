"""A viewer of `gradysim view` that replaces a browser."""

import json
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from websockets.sync.client import connect


def watched(command: str, folder: Path, **options: Any) -> tuple[dict[str, Any], int, str]:
    """Return the final message of the run of `gradysim view FILE.ini ...`, exit code and error output."""
    arguments = [*shlex.split(command)[1:], "--no-browser"]
    with subprocess.Popen(
        [sys.executable, "-m", "gradysim", *arguments],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        **options,
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        address = urlsplit(process.stdout.readline().strip())
        with connect(f"ws://{address.netloc}/chunks?{address.query}", max_size=None) as viewer:
            ends = (json.loads(message).get("end") for message in viewer if isinstance(message, str))
            end = next(filter(None, ends))
        error_output = process.stderr.read()
        return end, process.wait(20), error_output
