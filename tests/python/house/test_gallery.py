"""The commands and the figures in docs/gallery.md are those of the examples, in both modes."""

import re
from collections.abc import Callable
from pathlib import Path
from statistics import fmean

import pytest

pytest.importorskip("gradysim._netsim")

import gradysim.integrated.run
import gradysim.prototype.run
from gradysim.cli import examples
from gradysim.results.result import RunResult
from gradysim.scenario import load_scenarios
from python.viewing import watched

PAGE = "docs/gallery.md"
MODES = {"prototype": gradysim.prototype.run.run, "integrated": gradysim.integrated.run.run}


@pytest.fixture
def page(root: Path) -> str:
    """Return the text of the page in one line."""
    return " ".join((root / PAGE).read_text(encoding="utf-8").split())


def results(
    root: Path, file: str, config: str, mode: str, *settings: str, **iterations: object
) -> list[RunResult]:
    """Run those runs of a configuration that have these values of iteration variables."""
    scenarios = load_scenarios(root / "configs" / file, config, overrides=settings)
    values = {name: str(value) for name, value in iterations.items()}
    chosen = [scenario for scenario in scenarios if values.items() <= scenario.iterations.items()]
    assert chosen
    return [MODES[mode](scenario) for scenario in chosen]


@pytest.fixture
def mean(root: Path) -> Callable[..., float]:
    """`mean("search", "prototype", "found", lane=100)`: a variable over all runs and nodes of the study."""

    def compute(example: str, mode: str, variable: str, config: str = "Study", **iterations: object) -> float:
        return fmean(
            node.tracked_variables[variable]
            for result in results(root, f"{example}.ini", config, mode, **iterations)
            for node in result.nodes
            if variable in node.tracked_variables
        )

    return compute


def test_each_example_has_a_section_with_a_picture_but_those_of_guides(root: Path) -> None:
    *sections, more = (root / PAGE).read_text(encoding="utf-8").split("\n## ")[1:]
    names = [re.findall(r"^`(\w+)`: [^\n?]*\. [^\n?]*\?$", section, re.MULTILINE) for section in sections]
    assert names == [[name] for name in examples.NAMES[:10]]
    assert re.findall(r"`(\w+)`", more) == list(examples.NAMES[10:])
    for section in sections:
        pictures = re.findall(r"\]\((pictures/[\w/-]+\.png)\)", section)
        assert pictures
        assert all((root / "docs" / picture).is_file() for picture in pictures)


@pytest.mark.verify
def test_its_commands_copy_an_example_and_show_it(
    code_blocks: Callable[[str, str], list[str]], shell: Callable[..., str], tmp_path: Path
) -> None:
    (block,) = code_blocks(PAGE, "sh")
    new, into, view = block.splitlines()
    shell(new, tmp_path)
    assert watched(view, tmp_path / into.removeprefix("cd "))[0]["complete"]


@pytest.mark.verify
def test_search(page: str, mean: Callable[..., float]) -> None:
    ideal, real, far_ideal, far_real = (
        mean("search", mode, "found", lane=lane) for lane in (100, 200) for mode in MODES
    )
    assert ideal == 20
    assert (
        f"With lanes 100 m apart, the drones find all 20 beacons on the ideal radio, but {real:.1f} on a link"
        in page
    )
    assert f"With 200 m it is the other way round, {far_ideal:.1f} against {far_real:.1f}," in page


@pytest.mark.verify
def test_coverage(page: str, mean: Callable[..., float]) -> None:
    assert mean("coverage", "prototype", "parts", drones=16) == 200
    assert "16 drones deliver all 200 parts to everybody" in page
    few, many = (mean("coverage", "integrated", "parts", drones=drones) for drones in (16, 36))
    assert f"On the realistic one they deliver {few:.1f}," in page
    assert f"With 36 drones it is {many:.1f}." in page


@pytest.mark.verify
def test_relay_chain(page: str, mean: Callable[..., float]) -> None:
    assert {mean("relay_chain", "prototype", "received", rate=400, relays=relays) for relays in (1, 8)} == {
        4000
    }
    assert "all 4,000 messages of the fast stream arrive" in page
    one, two, eight = (
        mean("relay_chain", "integrated", "received", rate=400, relays=relays) for relays in (1, 2, 8)
    )
    assert f"{one:,.0f} arrive over one relay, {two:,.0f} over two and {eight:,.0f} over eight" in page


@pytest.mark.verify
def test_data_mule(page: str, mean: Callable[..., float]) -> None:
    assert {mean("data_mule", "prototype", "readings", speed=speed) for speed in (5, 40)} == {7500}
    assert "all 7,500 readings at any speed" in page
    slow, fast, faster = (mean("data_mule", "integrated", "readings", speed=speed) for speed in (10, 20, 40))
    assert slow == 7500
    assert (
        f"At 1 Mbps it also has them at 10 m/s, but {fast:,.0f} at 20 m/s and {faster:,.0f} at 40 m/s" in page
    )


@pytest.mark.verify
def test_leader_election(page: str, mean: Callable[..., float]) -> None:
    leaders = {
        (mode, wait): 20 * mean("leader_election", mode, "leads", wait=wait)
        for mode, wait in (
            ("prototype", "0s"),
            ("integrated", "0s"),
            ("integrated", "100us"),
            ("integrated", "100ms"),
        )
    }
    assert [round(number, 1) for number in leaders.values()] == [1, 20, 1.1, 1]
    assert "one of 20 leads. On the realistic one all 20 do," in page
    assert "A random wait of up to 100 µs leaves 1.1 leaders on average," in page
    assert "a wait of up to 100 ms leaves exactly one, as Raft does." in page
    for mode in MODES:
        assert 20 * mean("leader_election", mode, "leads", "Raft") == 1


@pytest.mark.verify
def test_collision_avoidance(page: str, mean: Callable[..., float]) -> None:
    closest = {
        (mode, video): f"{mean('collision_avoidance', mode, 'closest_m', video=video):.1f}"
        for mode in MODES
        for video in (0.5, 0.6)
    }
    assert closest["prototype", 0.5] == closest["prototype", 0.6] == "16.7"
    assert 16 < float(closest["integrated", 0.5]) <= 16.7
    assert "On the ideal radio they stay 16.7 m apart at any rate." in page
    age_s = mean("collision_avoidance", "integrated", "age_s", video=0.6)
    assert f"come as close as {closest['integrated', 0.6]} m with 0.6 Mbps" in page
    assert f"behind the video, for up to {age_s:.1f} s." in page


@pytest.mark.verify
def test_sensor_field(root: Path, page: str) -> None:
    acknowledged = {}
    for mode in MODES:
        for config in ("Spread", "Synchronised"):
            (result,) = results(root, "sensor_field.ini", config, mode)
            messages = result.outcomes["messages"]["unicast"]
            acknowledged[mode, config] = f"{messages['acknowledged']} of {sum(messages.values())}"
    assert [acknowledged["prototype", config] for config in ("Spread", "Synchronised")] == [
        "600 of 600",
        "620 of 620",
    ]
    assert f"{acknowledged['integrated', 'Spread']} are acknowledged if the sensors report at random" in page
    assert f"but {acknowledged['integrated', 'Synchronised']} if they all report" in page


def test_town(root: Path, page: str) -> None:
    def heard_by(config: str, mode: str, *settings: str) -> int:
        (result,) = results(root, "town/town.ini", config, mode, *settings)
        return sum(node.tracked_variables.get("received", 0) > 0 for node in result.nodes)

    as_far = "*.communicationMedium.transmissionRange = 787m"
    assert heard_by("Concrete", "prototype", as_far) == 8
    assert "with a range of 787 m, all 8 drones hear the station" in page
    concrete, antenna = (heard_by(config, "integrated") for config in ("Concrete", "SectorAntenna"))
    assert f"walls of concrete leave {concrete} of them" in page
    assert f"an antenna that looks along the street leaves {antenna}" in page


@pytest.mark.verify
def test_hidden_terminals(page: str, mean: Callable[..., float]) -> None:
    assert mean("hidden_terminals", "prototype", "received", rate=400) == 8000
    assert "all 8,000 parts of the fastest upload arrive" in page
    without, reserved = (
        mean("hidden_terminals", "integrated", "received", rate=400, rts=rts) for rts in ("3000B", "100B")
    )
    assert f"{without:,.0f} arrive, and {reserved:,.0f} with RTS/CTS" in page


def test_the_paper(root: Path, page: str) -> None:
    """tests/python/house/test_repeat_the_paper.py holds the table of that page."""
    table = (root / "docs/how-to/repeat-the-paper.md").read_text(encoding="utf-8")
    (ideal,) = re.findall(r"3 launches 30 s apart +prototype +([\d,]+) ", table)
    (lost,) = re.findall(r"3 launches 30 s apart +integrated +([\d,]+) ", table)
    (repaired,) = re.findall(r"4 random offset +integrated +([\d,]+) ", table)
    assert lost == "0"
    assert f"{ideal} readings arrive in the prototype and none on the realistic radio" in page
    assert f"then {repaired} arrive" in page
