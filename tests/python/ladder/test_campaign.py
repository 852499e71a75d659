"""Runs of a configuration with any set of effects."""

import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

import gradysim
from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.network import medium_config
from gradysim.ladder.campaign import Campaign, Effects
from gradysim.ladder.kept_runs import KeptRuns
from gradysim.ladder.observation import Observation
from gradysim.replay.reader import read_replay
from gradysim.scenario.errors import ConfigError

SCATTERED = """
*.nodes[*].mobility.initialX = uniform(0m, 60m)
*.nodes[*].mobility.initialY = uniform(0m, 60m)
*.radioMedium.pathLoss.typename = "RayleighFading"
*.radioMedium.shadowing.standardDeviation = 4dB
"""
RANDOM_TIMES = "**.protocol.spread=0.05"
RAIN = """
[Level rain]
description = "it rains"
*.radioMedium.backgroundNoise.power = -85dBm
[Level storm]
*.radioMedium.backgroundNoise.power = -75dBm
"""


def draws(campaign: Campaign, effects: Effects, index: int = 0) -> list[tuple[object, object]]:
    """Return the position of each node, and when it sent its last beacon."""
    with gradysim.start(campaign.scenario(effects, index)) as run:
        run.run_until()
    return [(node.position, node.tracked_variables["sent"]) for node in run.result().nodes]


def test_effects_change_neither_positions_nor_times_of_messages(
    make_campaign: Callable[..., Campaign],
) -> None:
    campaign = make_campaign(RANDOM_TIMES, "sim-time-limit=1.3s", file=SCATTERED)
    full = draws(campaign, campaign.all_effects)
    assert len(set(full)) == 3
    for level in campaign.levels:
        assert draws(campaign, campaign.all_effects - {level.name}) == full
    assert draws(campaign, frozenset()) == full


def gains_db(campaign: Campaign, *left_out: str) -> list[float]:
    """Return the gains of a link at several times, without some effects."""
    medium = medium_config(campaign.scenario(campaign.all_effects - set(left_out), 0))
    propagation = load_netsim().Propagation(medium, 1)
    return [
        10 * math.log10(propagation.gain((0, 0, 9), (500, 0, 9), 2.412e9, 0, 1, time_s))
        for time_s in (0.0, 0.003, 0.21, 1.7, 2.5)
    ]


@pytest.mark.parametrize("fading", ["RayleighFading", "RicianFading", "NakagamiFading"])
def test_shadowing_and_fading_change_nothing_of_each_other(
    make_campaign: Callable[..., Campaign], fading: str
) -> None:
    path_loss = "*.radioMedium.pathLoss.alpha = 2.7\n*.radioMedium.pathLoss.systemLoss = 3dB\n"
    free_space = gains_db(make_campaign(file=path_loss))
    typename = f'*.radioMedium.pathLoss.typename = "{fading}"\n'
    faded = gains_db(make_campaign(file=path_loss + typename))
    sigma = "*.radioMedium.shadowing.standardDeviation = 4dB\n"
    shadowed = gains_db(make_campaign(file=path_loss + sigma))

    campaign = make_campaign(file=path_loss + typename + sigma)
    assert gains_db(campaign, "shadowing") == faded
    assert gains_db(campaign, "fading") == shadowed
    assert gains_db(campaign, "shadowing", "fading") == free_space
    assert gains_db(campaign) == pytest.approx(
        [a + b - c for a, b, c in zip(shadowed, faded, free_space, strict=True)]
    )


def test_without_a_spread_shadowing_is_free_space(make_campaign: Callable[..., Campaign]) -> None:
    shadowing = '*.radioMedium.pathLoss.typename = "LogNormalShadowing"\n'
    assert gains_db(make_campaign(file=shadowing), "shadowing") == gains_db(make_campaign())


def test_runs_have_different_seeds(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign(RANDOM_TIMES, "sim-time-limit=1.3s", file=SCATTERED, run_count=2)
    assert len(campaign) == 2
    assert draws(campaign, frozenset(), 0) != draws(campaign, frozenset(), 1)


def noise_dbm(campaign: Campaign, *effects: str) -> str:
    field = campaign.scenario(frozenset({"radio", "noise", *effects}), 0).medium.get("background_noise_w")
    return "default" if field is None else f"{1000 * float(field.value):.3g} mW"


def test_lines_of_a_section_precede_those_of_the_file(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign(file="*.radioMedium.backgroundNoise.power = -95dBm\n" + RAIN)
    assert noise_dbm(campaign) == "3.16e-10 mW"
    assert noise_dbm(campaign, "rain") == "3.16e-09 mW"


def test_the_highest_section_is_on_top(make_campaign: Callable[..., Campaign]) -> None:
    assert noise_dbm(make_campaign(file=RAIN), "rain", "storm") == "3.16e-08 mW"


def test_an_error_in_a_section_has_its_line(make_campaign: Callable[..., Campaign], tmp_path: Path) -> None:
    file = "\n[Level rain]\n*.radioMedium.backgroundNoise.power = -85m\n"
    campaign = make_campaign(file=file)
    line = len((tmp_path / "test.ini").read_text(encoding="utf-8").splitlines())
    with pytest.raises(ConfigError, match=rf"test\.ini:{line}: .*-85m"):
        campaign.scenario(campaign.all_effects, 0)


def test_an_error_of_the_configuration_has_its_line(make_campaign: Callable[..., Campaign]) -> None:
    with pytest.raises(ConfigError, match=r"test\.ini:\d+: .*pathLos"):
        make_campaign(file="*.radioMedium.pathLos.alpha = 3\n")


@pytest.mark.parametrize("with_executor", [False, True])
def test_an_observation_has_the_metric_and_the_losses(
    make_campaign: Callable[..., Campaign], with_executor: bool
) -> None:
    campaign = make_campaign(run_count=2)
    with ThreadPoolExecutor(1) as executor:
        chosen = executor if with_executor else None
        seen = list(campaign.observations(chosen, campaign.all_effects, range(2), ["nodes[*] heard"]))
    assert [each.numbers["nodes[*] heard"] for each in seen] == [0, 0]
    beacons = 3 * 41
    assert seen[0].losses == {"receiver_transmitting": 2 * beacons}
    assert seen[0].receptions == 2 * beacons
    assert {name: count for name, count in seen[0].messages.items() if count} == {"sent": beacons}


def test_an_unknown_metric_is_refused_with_the_nearest_one(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign()
    with pytest.raises(ConfigError, match=r" `nodes\[\*\] heard`"):
        list(campaign.observations(None, campaign.all_effects, range(1), ["nodes[*] herd"]))


def test_a_run_that_fails_has_no_numbers_but_the_exception_and_its_line(
    make_campaign: Callable[..., Campaign], tmp_path: Path
) -> None:
    campaign = make_campaign("**.protocol.interval=-1")
    (seen,) = campaign.observations(None, campaign.all_effects, range(1), ["nodes[*] heard"])
    assert not seen.numbers
    assert seen.failure is not None
    assert seen.failure.exception == "TimerException"
    assert seen.failure.where == "in handle_timer of node 0 (Beacon 0) at 1 s of simulated time"
    source = (tmp_path / "protocol.py").read_text(encoding="utf-8").splitlines()
    file, _, number = seen.failure.line.rpartition(":")
    assert Path(file) == tmp_path / "protocol.py"
    assert "schedule_timer" in source[int(number) - 1]


def test_a_run_that_fails_is_recorded_up_to_there(
    make_campaign: Callable[..., Campaign], tmp_path: Path
) -> None:
    campaign = make_campaign("**.protocol.interval=-1")
    seen = campaign.record(campaign.all_effects, 0, tmp_path / "run.html")
    assert seen.failure is not None
    assert read_replay(tmp_path / "run.html").end_s == 1


def test_a_campaign_finds_the_runs_that_are_kept(
    make_campaign: Callable[..., Campaign], tmp_path: Path
) -> None:
    def seen(resume: bool, *settings: str) -> tuple[list[Observation], Campaign]:
        with KeptRuns(tmp_path / "kept", "General", resume=resume) as kept:
            campaign = make_campaign(*settings, run_count=3, kept=kept)
            return list(campaign.observations(None, campaign.all_effects, range(3))), campaign

    first, _ = seen(False)
    again, campaign = seen(True)
    assert again == first
    assert (campaign.run_count, campaign.kept_count) == (0, 3)
    _, other = seen(True, "**.protocol.step=0.01")
    assert (other.run_count, other.kept_count) == (3, 0)
    _, without_resume = seen(False)
    assert without_resume.run_count == 3


@pytest.mark.parametrize("damage", ["cut", "changed", "empty"])
def test_a_kept_run_that_is_damaged_is_done_again(
    make_campaign: Callable[..., Campaign], tmp_path: Path, damage: str
) -> None:
    for resume in (False, True, True):
        with KeptRuns(tmp_path, "General", resume=resume) as kept:
            campaign = make_campaign(run_count=2, kept=kept)
            list(campaign.observations(None, campaign.all_effects, range(2)))
        if not resume:
            text = kept.path.read_text(encoding="utf-8")
            changed = {"cut": text[:-40], "changed": text.replace("heard", "haerd", 1), "empty": ""}
            kept.path.write_text(changed[damage], encoding="utf-8")
            done = 0 if damage == "empty" else 1
        else:
            assert campaign.kept_count == done
            done = 2


FLYING = ('*.nodes[*].mobility.typename="QuadcopterMobility"', "*.nodes[*].mobility.initialZ=20m")
WINDY = """
*.wind.speed = 5mps
*.wind.gusts = 1mps
*.nodes[*].mobility.positionError = 1m
"""


def test_effects_of_motion_change_no_other_draws(make_campaign: Callable[..., Campaign]) -> None:
    settings = (RANDOM_TIMES, "sim-time-limit=2s", *FLYING)
    campaign = make_campaign(*settings, file=SCATTERED + WINDY)
    assert [level.name for level in campaign.levels][-3:] == ["inertia", "wind", "position"]
    at_rest = draws(campaign, campaign.all_effects - {"inertia"})
    for name in ("wind", "position"):
        # Without inertia, nothing acts on the nodes.
        assert draws(campaign, campaign.all_effects - {"inertia", name}) == at_rest
    gusts = drift(campaign, campaign.all_effects - {"position"})
    assert drift(campaign, campaign.all_effects - {"position", "fading", "noise"}) == gusts
    assert [sent for _, sent in draws(campaign, campaign.all_effects)] == [sent for _, sent in at_rest]


def drift(campaign: Campaign, effects: Effects) -> list[object]:
    positions = [position for position, _ in draws(campaign, effects)]
    assert positions != [node.initial_position for node in campaign.scenario(effects, 0).nodes]
    return positions
