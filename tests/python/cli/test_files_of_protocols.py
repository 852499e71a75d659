"""Files written by protocols, in a configuration with several runs."""

import pytest

from python.cli.command import both_modes

COUNTS = """
from gradysim.protocol.plugin.statistics import create_statistics, finish_statistics
from protocol import Talker


class Counted(Talker):
    def initialize(self):
        super().initialize()
        create_statistics(self, "part", 1)

    def finish(self):
        finish_statistics(self)
"""

COUNTED = ("--set", '*.uavs[*].protocol.class="counts.py:Counted"', "--set", "*.uavs.count=1")


@both_modes
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_statistics_of_each_run_have_files_of_their_own(gradysim, folder, mode, jobs):
    (folder / "counts.py").write_text(COUNTS)
    done = gradysim("run", "test.ini", "--mode", mode, "--jobs", jobs, *COUNTED)
    assert done.returncode == 0
    assert {file.name for file in folder.glob("*.csv")} == {
        f"{kind}_General-#{run}.{mode}_part_Counted_0.csv"
        for kind in ("simulation_real_time", "tracked_variables")
        for run in range(3)
    }


@both_modes
def test_those_of_the_only_run_have_the_published_names(gradysim, folder, mode):
    (folder / "counts.py").write_text(COUNTS)
    gradysim("run", "test.ini", "--mode", mode, *COUNTED, "--set", "repeat=1")
    assert {file.name for file in folder.glob("*.csv")} == {
        f"{kind}_part_Counted_0.csv" for kind in ("simulation_real_time", "tracked_variables")
    }
