"""Signals that stop a study at a random instant: results are kept, and no process is left."""

import os
import time
from pathlib import Path
from random import Random

from gradysim.cli.interrupt import STOPPING
from gradysim.results.files import read_run_file
from gradysim.scenario.resolve.runs import hash_of
from python.torture.study import OUT, assert_resume_completes, begin, content_of, end_of, prepare, undisturbed


def once(random: Random, folder: Path) -> int:
    """Send one of the signals, to the command or to all of its processes; return 1."""
    prepare(folder)
    expected, duration_s = undisturbed()
    number = random.choice(STOPPING)
    process = begin(folder, "--jobs", str(random.randint(1, 3)))
    time.sleep(random.uniform(0, duration_s))
    if process.poll() is None:
        random.choice([os.kill, os.killpg])(process.pid, number)
    # Before the command handles it, the signal ends the interpreter.
    assert end_of(process) in (0, 128 + number, -number)
    if (folder / OUT).is_dir():
        assert content_of(folder / OUT).keys() <= expected.keys()
        for file in (folder / OUT).glob("*.json"):
            hashes = read_run_file(file)["output_hashes"]
            assert hashes == {name: hash_of(folder / OUT / name) for name in hashes}
            assert hashes
    assert_resume_completes(folder, random)
    return 1
