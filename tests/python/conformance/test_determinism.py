"""The same seed gives the same run: again, next to another run, in another process. Another seed does not."""

import json
import os
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

from gradysim.integrated.run import IntegratedRun
from gradysim.results.result import RunResult
from gradysim.scenario import Scenario, load_scenarios

ROOT = Path(__file__).parents[3]
FILE = ROOT / "configs" / "zigzag.ini"
LIMIT_S = 300.0
CONFIGS = ["ZigZag15", "ZigZag15Synchronised"]


def scenario(config: str, seed: int = 1) -> Scenario:
    (loaded,) = load_scenarios(FILE, config, overrides=[f"seed-set = {seed}", f"sim-time-limit = {LIMIT_S}s"])
    return loaded


def fly(config: str, seed: int = 1) -> RunResult:
    run = IntegratedRun(scenario(config, seed))
    run.execute()
    return run.result()


alone = cache(fly)


def what_happened(result: RunResult) -> tuple[object, ...]:
    """Return the result without its run times."""
    return result.events, result.fingerprint, result.outcomes, result.nodes


@pytest.mark.parametrize("config", CONFIGS)
def test_the_same_again(config: str) -> None:
    assert what_happened(fly(config)) == what_happened(alone(config))


@pytest.mark.parametrize("config", CONFIGS)
def test_the_same_while_another_run_goes_on(config: str) -> None:
    runs = [IntegratedRun(scenario(config)), IntegratedRun(scenario(config, seed=2))]
    networks = [run._network for run in runs]
    for network in networks:
        network.initialize()
    pending = list(networks)
    while pending:
        pending = [network for network in pending if not network.run_until(LIMIT_S, 7)]
    for network in networks:
        network.finish()
        network.release_protocols()
    expected = [alone(config), alone(config, 2)]
    assert [what_happened(run.result()) for run in runs] == [what_happened(result) for result in expected]


@pytest.mark.parametrize("config", CONFIGS)
def test_another_seed_gives_another_run(config: str) -> None:
    assert len({alone(config, seed).fingerprint for seed in range(4)}) == 4


@pytest.mark.parametrize("hash_seed", ["0", "1", "4294967295"])
@pytest.mark.parametrize("config", CONFIGS)
def test_the_same_in_another_process_whatever_the_order_of_its_sets(config: str, hash_seed: str) -> None:
    python_path = os.pathsep.join([str(ROOT / "python"), *filter(None, [os.environ.get("PYTHONPATH")])])
    limits = ["--set", "seed-set=1", "--set", f"sim-time-limit={LIMIT_S}s"]
    output = subprocess.run(
        [sys.executable, "-m", "gradysim", "run", FILE, "-c", config, "--json", "--quiet", *limits],
        env={**os.environ, "PYTHONHASHSEED": hash_seed, "PYTHONPATH": python_path},
        capture_output=True,
        check=True,
        text=True,
    ).stdout
    result = json.loads(output)
    assert (result["result_hash"], result["events"]) == (alone(config).result_hash, alone(config).events)
