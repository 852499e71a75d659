"""The stub of the compiled part matches its content; `make lint` runs this file."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[3] / "python"

OF_PYBIND11 = re.compile(r"metaclass differs|stub does not have \*args parameter")
"""Its metaclass has no name, and a class without a constructor has one that rejects all arguments."""


@pytest.mark.verify
def test_it_is_that_of_the_module(tmp_path: Path) -> None:
    said = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "gradysim._netsim", "--concise"],
        cwd=tmp_path,  # otherwise it leaves a cache here
        env={**os.environ, "MYPYPATH": str(PACKAGE), "PYTHONPATH": str(PACKAGE)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert said.stderr == ""
    assert [line for line in said.stdout.splitlines() if not OF_PYBIND11.search(line)] == []
