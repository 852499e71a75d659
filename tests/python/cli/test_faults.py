"""System calls of each command fail, one after the other: `make torture` tries all of them."""

import shutil
import sys

import pytest

pytest.importorskip("gradysim._netsim")

from python.torture.bad_disk import FAULTS, BadDisk
from python.torture.faults import CASES, Bench
from python.torture.study import OUT

pytestmark = pytest.mark.skipif(
    sys.platform != "linux" or shutil.which("cc") is None, reason="it preloads a library, which it compiles"
)

STEP = 7
"""Every how many calls `make test-slow` tries one."""

SAMPLE = {
    "run": "POWER",
    "run --replace": "ENOSPC",
    "run --resume": "INT",
    "pack": "KILL",
    "pack --unpack": "POWER",
    "plot": "TERM",
}
"""Faults of `make test`. All others are EIO."""


@pytest.fixture(scope="module")
def disk():
    with BadDisk(OUT) as disk:
        yield disk


@pytest.mark.parametrize("name", CASES)
def test_a_fault_in_the_middle_loses_nothing(name, disk, tmp_path):
    bench, fault = Bench(name, tmp_path, disk), SAMPLE.get(name, "EIO")
    assert bench.check(fault, bench.calls(fault) // 2).failed > 0


@pytest.mark.verify
@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.parametrize("name", CASES)
def test_no_fault_loses_anything(name, fault, disk, tmp_path):
    bench = Bench(name, tmp_path, disk)
    for at in range(1, bench.calls(fault) + 1, STEP):
        bench.check(fault, at)
