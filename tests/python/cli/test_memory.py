"""`gradysim run --memory`: a run that needs more fails, and the others continue."""

import sys

import pytest

from gradysim.cli.memory import checked_limit
from gradysim.scenario.errors import ConfigError
from python.cli.command import both_modes, deaths, objects

pytestmark = pytest.mark.skipif(
    sys.platform != "linux", reason="only Linux can limit the memory of a process"
)

GREEDY = """
from protocol import Talker

class Greedy(Talker):
    wants = 0
    def initialize(self):
        super().initialize()
        self.eaten = []
    def handle_timer(self, timer):
        super().handle_timer(timer)
        if self.wants and self.provider.current_time() > 5:
            while True:
                self.eaten.append(bytes(10_000_000))
"""


@both_modes
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_greedy_run_fails_and_the_others_go_on(gradysim, folder, mode, jobs):
    (folder / "greedy.py").write_text(GREEDY)
    settings = ('class="greedy.py:Greedy"', "wants=${wants=0, 1, 0}")
    arguments = [part for line in settings for part in ("--set", f"*.uavs[*].protocol.{line}")]
    options = ("--json", "--jobs", jobs, "--memory", "2GB", "--result-dir", "out", "--set", "repeat=1")
    done = gradysim("run", "test.ini", "--mode", mode, *arguments, *options)
    assert done.returncode == 4
    runs = [
        (run["run"], run["interrupted"], run["nodes"][0]["tracked_variables"]) for run in objects(done.stdout)
    ]
    assert runs == [(0, False, {"said": 10}), (1, True, {"said": 5}), (2, False, {"said": 10})]
    assert "MemoryError" in done.stderr
    assert deaths(done.stderr) == {1: "2GB"}
    assert done.stderr.endswith(" (0,2)\n")
    assert len(list((folder / "out").iterdir())) == 3


@pytest.mark.parametrize(
    ("text", "limit_bytes"), [(None, None), ("2GB", 2 * 10**9), ("512MiB", 2**29), ("1e9B", 10**9)]
)
def test_limits_in_bytes(text, limit_bytes):
    assert checked_limit(text) == limit_bytes


@pytest.mark.parametrize("text", ["2", "2GHz", "0B", "-1GB", "much", ""])
def test_other_limits_are_mistakes(gradysim, text):
    with pytest.raises(ConfigError):
        checked_limit(text)
    done = gradysim("run", "test.ini", "--mode", "prototype", f"--memory={text}")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"--memory {text}: ")
