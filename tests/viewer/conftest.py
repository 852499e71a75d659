import json
import os
import shutil
import subprocess
import sys
from collections import Counter
from contextlib import contextmanager
from pathlib import Path
from subprocess import PIPE

import pytest

from gradysim.integrated.run import IntegratedRun
from gradysim.replay.sink import ReplayWriter
from gradysim.scenario import load_scenarios

ROOT = Path(__file__).parents[2]
TEMPLATE = ROOT / "python/gradysim/cli/templates/scenario.ini"


def record(path, file, config, duration):
    """Write the replay of the first seconds of an example."""
    scenario = load_scenarios(ROOT / "configs" / file, config, overrides=[f"sim-time-limit={duration}"])[0]
    IntegratedRun(scenario, replay=ReplayWriter(path)).execute()
    return path


@pytest.fixture(scope="session")
def zigzag(tmp_path_factory):
    """The replay of a run in which all send their heartbeats at the same instants."""
    path = tmp_path_factory.mktemp("replay") / "zigzag.html"
    return record(path, "zigzag.ini", "ZigZag5Synchronised", "250s")


@pytest.fixture(scope="session")
def reports(tmp_path_factory):
    """The replay of a run in which all vehicles fly together."""
    return record(tmp_path_factory.mktemp("replay") / "reports.html", TEMPLATE, "Jittered", "15s")


@pytest.fixture(scope="session")
def collisions(tmp_path_factory):
    """The replay of a run in which all vehicles fly together and send at the same instants."""
    return record(tmp_path_factory.mktemp("replay") / "collisions.html", TEMPLATE, "General", "15s")


@pytest.fixture(scope="session")
def town(tmp_path_factory):
    """The replay of a run with obstacles."""
    return record(tmp_path_factory.mktemp("replay") / "town.html", "town/town.ini", "Concrete", "1s")


@pytest.fixture(scope="session")
def viewer():
    """The directory of the page's sources, with the packages of npm."""
    need((ROOT / "viewer/node_modules").is_dir(), "the packages of npm: `make viewer` installs them")
    return ROOT / "viewer"


@pytest.fixture(scope="session")
def browser(viewer):
    """A function that opens a replay in Chromium and returns what it shows; see browser.mjs."""
    need(shutil.which("chromium"), "Chromium: `make test-viewer` installs it")

    def show(file, **asked):
        done = subprocess.run(
            ["node", Path(__file__).with_name("browser.mjs")],
            input=json.dumps({"file": str(file), **asked}),
            capture_output=True,
            text=True,
            timeout=300,
        )
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    return show


def state(replay, time_s):
    """Return the state that `gradysim.state` of the page gives, computed from the tables."""
    began = [start <= time_s * 1e9 for start in replay.table("frames")["time_ns"]]
    outcomes = Counter(reception.outcome for reception in replay.receptions() if began[reception.frame])
    outcomes["below_sensitivity"] = sum(
        count for count, has in zip(replay.table("frames")["unnoticed"], began, strict=True) if has
    )
    positions = [list(place) for place in replay.positions(time_s)]
    return {"time_s": time_s, "positions": positions, "frames": sum(began), "outcomes": dict(+outcomes)}


@contextmanager
def viewing(*arguments):
    """Start `gradysim view`; return its process and the address of its page."""
    command = [sys.executable, "-m", "gradysim", "view", *arguments, "--no-browser"]
    with subprocess.Popen(command, stdout=PIPE, stderr=PIPE, text=True) as view:
        try:
            yield view, view.stdout.readline().strip()
        finally:
            view.kill()


def need(is_there, what):
    if not is_there:
        (pytest.fail if os.environ.get("CI") else pytest.skip)(f"needs {what}")
