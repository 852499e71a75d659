"""Every frame at every radio, against a second implementation of the model, in plain Python.

It shares no code with the engine. Sent frames are taken from the senders' captures. `verification.oracle`
computes which other radios lock on to them and decode them. Its results are compared with the receivers'
captures and with the outcomes of frames.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from math import inf, nextafter
from pathlib import Path

import pytest

from verification.finding import Finding
from verification.oracle.case import Air, Case, Receiver, Station
from verification.oracle.comparison import Comparison, compare
from verification.oracle.engine_run import EngineRun, run_engine
from verification.oracle.exact_case import exact_case
from verification.oracle.random_case import random_case

MOST_LEFT_OUT = 0.02


def comparisons(make: Callable[[int], Case], count: int, folder: Path) -> Iterator[Comparison]:
    for seed in range(count):
        case = make(seed)
        yield compare(case, run_engine(case, folder))


@pytest.mark.parametrize(
    ("name", "make", "count", "thorough_count"),
    [
        ("every frame at every radio of {} random networks", random_case, 100, 6000),
        ("the same in {} networks that meet thresholds exactly, at equal times", exact_case, 100, 2000),
    ],
    ids=["random", "exact"],
)
def test_the_oracle_predicts_the_engine(
    name: str,
    make: Callable[[int], Case],
    count: int,
    thorough_count: int,
    report: Callable[[Finding], None],
    tmp_path: Path,
    pytestconfig: pytest.Config,
) -> None:
    if pytestconfig.getoption("--verify"):
        count = thorough_count
    found = list(comparisons(make, count, tmp_path))
    differences = [line for one in found for line in one.differences]
    arrivals, receptions, by_chance, radios, left_out = (
        sum(getattr(one, field) for one in found)
        for field in ("outcomes", "receptions", "uncertain", "radios", "left_out")
    )
    share = left_out / (radios + left_out)
    assert differences == []
    report(
        Finding(
            f"{name.format(count)}, against a second implementation of the model",
            f"{len(differences)} of {arrivals} arrivals differ; {receptions} of them received to the end, "
            f"{by_chance} with a chance of 1 % to 99 %; {share:.1%} of the radios left out",
            f"0; left out {MOST_LEFT_OUT:.0%}",
            "nothing is random: the oracle has the receivers' random numbers, too; at radios left out, the "
            "order of events is hidden in the nanosecond to which captures are cut",
            not differences and share <= MOST_LEFT_OUT,
        )
    )


# A useful oracle disagrees with a wrong engine: here, with the engine's run of another case.

Change = Callable[[Case], Case]


def receivers(change: Callable[[Receiver], Receiver]) -> Change:
    return stations(lambda station: replace(station, receiver=change(station.receiver)))


def stations(change: Callable[[Station], Station]) -> Change:
    return lambda case: replace(case, stations=tuple(change(station) for station in case.stations))


def sensitivity(change: Callable[[float], float]) -> Change:
    return receivers(lambda one: replace(one, sensitivity_w=change(one.sensitivity_w)))


def threshold(change: Callable[[float], float]) -> Change:
    return receivers(lambda one: replace(one, snir_threshold=change(one.snir_threshold)))


def energy(change: Callable[[float], float]) -> Change:
    return receivers(lambda one: replace(one, energy_detection_w=change(one.energy_detection_w)))


def noise(factor: float) -> Change:
    def change(air: Air) -> Air:
        if air.temperature_k is None:
            return replace(air, noise_w=air.noise_w * factor)
        return replace(air, temperature_k=air.temperature_k * factor)

    return lambda case: replace(case, air=change(case.air))


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> list[tuple[Case, EngineRun]]:
    folder = tmp_path_factory.mktemp("captures")
    cases = [random_case(seed) for seed in range(100)] + [exact_case(seed) for seed in range(100)]
    return [(case, run_engine(case, folder)) for case in cases]


@pytest.mark.parametrize(
    "change",
    [
        pytest.param(sensitivity(lambda power_w: power_w * 1.01), id="a sensitivity 1 % off"),
        pytest.param(sensitivity(lambda power_w: nextafter(power_w, inf)), id="more than the sensitivity"),
        pytest.param(threshold(lambda ratio: ratio * 0.99), id="a threshold 1 % off"),
        pytest.param(threshold(lambda ratio: nextafter(ratio, 0)), id="no less than the threshold"),
        pytest.param(energy(lambda power_w: power_w * 1.01), id="1 % more energy for a busy channel"),
        pytest.param(energy(lambda power_w: power_w * 0.99), id="1 % less energy for a busy channel"),
        pytest.param(energy(lambda power_w: nextafter(power_w, inf)), id="more than that energy"),
        pytest.param(noise(1.01), id="1 % more noise"),
        pytest.param(noise(1e-9), id="no noise"),
        pytest.param(lambda case: replace(case, seed=case.seed + 1), id="other random numbers"),
        pytest.param(
            stations(lambda one: replace(one, position=(one.position[0] * 1.001, *one.position[1:]))),
            id="places 0.1 % off",
        ),
        pytest.param(stations(lambda one: replace(one, courses=())), id="no motion"),
        pytest.param(receivers(lambda one: replace(one, by_chunks=False)), id="one SNIR for the whole frame"),
        pytest.param(receivers(lambda one: replace(one, preamble_detection=None)), id="no detection"),
        pytest.param(receivers(lambda one: replace(one, frame_capture=None)), id="no frame capture"),
    ],
)
def test_the_oracle_notices(change: Change, runs: list[tuple[Case, EngineRun]]) -> None:
    assert any(compare(change(case), run).differences for case, run in runs)
