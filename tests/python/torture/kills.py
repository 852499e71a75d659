"""SIGKILL at a random instant of a study: --resume gives the results of an undisturbed study."""

import contextlib
import os
import signal
import time
from pathlib import Path
from random import Random

from python.processes import session
from python.torture.study import assert_resume_completes, begin, end_of, prepare, undisturbed


def once(random: Random, folder: Path) -> int:
    """Kill a command, all of its processes or one of its workers; return 1."""
    prepare(folder)
    _, duration_s = undisturbed()
    process = begin(folder, "--jobs", str(random.randint(1, 3)))
    time.sleep(random.uniform(0, duration_s))
    victims = random.choice([[process.pid], session(process.pid), session(process.pid)[-1:]])
    for pid in victims:
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)
    assert end_of(process) in (0, 1, -signal.SIGKILL)
    assert_resume_completes(folder, random)
    return 1
