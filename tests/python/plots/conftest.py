"""A study, and axes for drawings."""

from pathlib import Path

import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from gradysim.results import Runs, runs
from python.study_files import write_result


@pytest.fixture
def axes() -> Axes:
    return Figure().subplots()


@pytest.fixture
def study(tmp_path: Path) -> Runs:
    """Return two values of a variable in both modes, with three runs of the same seeds each.

    With 1 ms, integrated mode counts 1, 2 and 3 more than 10; with 2 ms, 0, 0 and 1 more than 20. The
    prototype counts 10 and 20.
    """
    more = {"1ms": (1, 2, 3), "2ms": (0, 0, 1)}
    for mode in ("integrated", "prototype"):
        for number, (jitter, seed) in enumerate([(j, s) for j in more for s in range(3)]):
            heard = {"1ms": 10, "2ms": 20}[jitter] + (more[jitter][seed] if mode == "integrated" else 0)
            write_result(
                tmp_path, number, (heard,), mode=mode, seed=seed, iterations={"jitter": jitter}, cpu_s=2.0
            )
    return runs(tmp_path)
