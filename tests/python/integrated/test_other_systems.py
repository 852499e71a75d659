"""Noise of other systems: runs, link budgets and explanations of losses agree about it."""

from pathlib import Path

import pytest

from gradysim.integrated.calibration import link_budget
from gradysim.integrated.run import IntegratedRun, run
from gradysim.prototype.run import run as run_prototype
from gradysim.replay import read_replay
from gradysim.replay.sink import ReplayWriter
from python.integrated.fading_link import link

NOISE = (
    "*.radioMedium.otherSystems.power = -90dBm",
    "*.radioMedium.otherSystems.standardDeviation = 8dB",
    "*.radioMedium.otherSystems.coherenceTime = 5ms",
    "**.bitrate = 24Mbps",
)
CHUNKS = '**.errorModel.snirMode = "chunks"'
ALOHA = '*.radioMedium.timing = "aloha"'


@pytest.mark.parametrize("lines", [(), (CHUNKS,), (ALOHA,)])
def test_a_run_delivers_what_the_link_budget_says(lines: tuple[str, ...]) -> None:
    scenario = link(*NOISE, *lines)
    power_w = 0.02
    budget = link_budget(scenario, scenario.nodes[0], scenario.nodes[1], 100)
    sender, *receivers = run(scenario).nodes
    sent = int(str(sender.tracked_variables["sent"]))
    for spec, node in zip(scenario.nodes[1:], receivers, strict=True):
        distance_m = (spec.initial_position[0] ** 2 + 28**2) ** 0.5
        delivered = int(str(node.tracked_variables["received"])) / sent
        assert delivered == pytest.approx(budget.reception_ratio(distance_m, power_w), abs=0.05)


def test_losses_have_the_noise_as_it_was(tmp_path: Path) -> None:
    scenario = link(*NOISE, "sim-time-limit = 2s")
    IntegratedRun(scenario, replay=ReplayWriter(tmp_path / "run.html")).execute()
    replay = read_replay(tmp_path / "run.html")
    outcomes = replay.outcomes()
    losses = list(replay.losses())
    assert outcomes["noise"] == len(losses) > 500
    assert "interference" not in outcomes
    assert len({loss.noise_dbm for loss in losses}) > len(losses) / 2
    for loss in losses:
        assert loss.interference_dbm is None
        assert loss.sinr_db is not None
        assert loss.sinr_db < loss.needed + 3  # a little above, a frame may still be lost


def test_other_random_numbers_stay() -> None:
    weak = "*.radioMedium.otherSystems.power = 1e-30W"
    fading = '*.radioMedium.pathLoss.typename = "RayleighFading"'
    assert run(link(fading, weak, NOISE[1])).fingerprint == run(link(fading)).fingerprint


def test_a_run_repeats_and_another_seed_differs() -> None:
    found = [
        run(link(*NOISE, f"seed-set = {seed}", "sim-time-limit = 1.5s")).fingerprint for seed in (1, 1, 2)
    ]
    assert found[0] == found[1] != found[2]


def test_prototype_mode_does_not_have_it() -> None:
    with_noise, without = (
        [node.tracked_variables for node in run_prototype(link(*lines)).nodes] for lines in (NOISE, ())
    )
    assert with_noise == without
