"""Files as a whole: sections, variables, time limits; and that the result loads."""

import itertools
from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.omnetpp_import import Action, Translation, translate
from gradysim.scenario import load_scenarios
from gradysim.scenario.errors import ConfigError
from python.calls import count_calls
from python.quiet_protocol import QUIET

Translated = Callable[..., Translation]

INI = """[General]
cmdenv-status-frequency = 10s
*.visualizer.**.displayRoutes = true
**.mobility.initFromDisplayString = false
*.coordinateSystem.sceneLatitude = -15.84deg
*.coordinateSystem.sceneLongitude = -47.92deg

[Config Wifi]
network = GradysNetwork
*.quads[*].app[0].typename = "UdpCommunicationApp"
*.quads[*].protocol.typename = "PythonDroneProtocol"
*.quads[*].mobility.typename = "DroneMobility"
*.*.mobility.coordinateSystemModule = "coordinateSystem"
*.quads[*].mobility.homeLatitude = -15.841deg
*.groundStation.mobility.initialLatitude = -15.84deg
**.wlan[*].mac.*.rateSelection.dataFrameBitrate = 6Mbps

[Config Study]
extends = Wifi
sim-time-limit = ${20s, 10s, 5s ! speed}
*.numUAVs = 2
*.quads[*].mobility.speed = ${speed=5mps, 10mps}
*.quads[1].mobility.homeLatitude = -15.842deg
*.*.protocol.protocolFileName = "quiet"
*.*.protocol.protocolMobile = "Quiet"
"""


def test_the_result_loads(translated: Translated, tmp_path: Path) -> None:
    translation = translated(INI)
    (tmp_path / "quiet.py").write_text(QUIET)
    (tmp_path / "imported").mkdir()
    file = tmp_path / "imported" / "omnetpp.ini"
    file.write_text(translation.text)
    scenarios = load_scenarios(file, "Study")
    assert [scenario.sim_time_limit_s for scenario in scenarios] == [20, 10]
    names = {spec.name for spec in scenarios[0].nodes}
    assert names == {"quads[0]", "quads[1]", "sensors[0]", "groundStation"}
    assert scenarios[0].medium["typename"].value == "Ieee802154NarrowbandScalarRadioMedium"
    first = next(spec for spec in scenarios[0].nodes if spec.name == "quads[0]")
    assert first.initial_position == pytest.approx((-111.195, 0, 0))


def test_each_line_is_listed_once_in_its_order(translated: Translated) -> None:
    outcomes = translated(INI).outcomes
    listed = [outcome.entry.source.line for outcome in outcomes if outcome.entry]
    lines = INI.splitlines()
    assert listed == [number for number, line in enumerate(lines, 1) if "=" in line]
    assert all(outcome.entry is None for outcome in outcomes[len(listed) :])


def test_counts(translated: Translated) -> None:
    counts = translated(INI).counts()
    assert counts.total() == len(translated(INI).outcomes)
    assert counts[Action.TO_WRITE] == 0
    assert list(counts) == [action for action in Action if action in counts]


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("[General]\n[Config A]\n[Config B]\nextends = A\n", 1),
        ("[Config A]\n[Config B]\nextends = A\nsim-time-limit = 1s\n", 1),
        ("[Config A]\nsim-time-limit = 1s\n[Config B]\nextends = A\n", 0),
        ("[General]\nsim-time-limit = 1s\n[Config A]\n", 0),
        ("[General]\nsim-time-limit = ${lost}\n", 1),
    ],
)
def test_a_time_limit_is_added_below_all_others(translated: Translated, text: str, count: int) -> None:
    found = translated(text)
    added = [each.text for each in found.outcomes if each.action is Action.ADDED]
    assert added == ["sim-time-limit = 600s"] * count
    general = found.text.partition("[Config")[0]
    assert general.count("\nsim-time-limit = 600s\n") == count
    assert "abstract" not in found.text


def test_what_is_not_modelled_is_a_comment_of_one_line(translated: Translated) -> None:
    found = translated('[General]\n**.wlan[*].mac.typename = ${"XMac",\n  "BMac"}\n')
    assert ': **.wlan[*].mac.typename = ${"XMac", "BMac"}  (' in found.text
    assert found.counts()[Action.NOT_MODELLED] == 1


def test_each_of_several_networks_has_its_own_defaults(translated: Translated) -> None:
    ned = "network N { submodules: radioMedium: UnitDiskRadioMedium; host: AdhocHost; }"
    text = translated("[Config A]\nnetwork = GradysNetwork\n[Config B]\nnetwork = N\n", ned).text
    first, second = text.split("[Config B]")
    assert "Narrowband" in first
    assert "Narrowband" not in second
    assert '*.radioMedium.typename = "UnitDiskRadioMedium"' in second


def test_lines_that_lose_their_variable_are_left_to_the_user(translated: Translated) -> None:
    text = translated(
        "[General]\nsim-time-limit = ${1s, 2s ! wait}\n"
        '*.quads[*].protocol.wait = ${wait=1s, 2s}\nexperiment-label = "${wait} in ${configname}"\n'
    ).text
    assert text.count("write:") == 3


def test_continued_values_stay_indented(translated: Translated) -> None:
    text = translated("[General]\nsim-time-limit = ${1s,\n  2s}\n").text
    assert "sim-time-limit = ${1s,\n    2s}\n" in text


def test_a_file_that_is_not_understood(tmp_path: Path) -> None:
    (tmp_path / "omnetpp.ini").write_text("[General\n")
    with pytest.raises(ConfigError, match="heading"):
        translate(tmp_path / "omnetpp.ini", tmp_path)


def test_a_class_to_write_is_not_inherited(translated: Translated, tmp_path: Path) -> None:
    text = translated(
        '[Config Base]\nnetwork = GradysNetwork\n*.quads[*].protocol.typename = "DadcaProtocol"\n'
        '[Config Heir]\nextends = Base\n*.quads[*].protocol.typename = "OwnProtocol"\n'
    ).text
    (tmp_path / "translated.ini").write_text(text)
    assert len(load_scenarios(tmp_path / "translated.ini", "Base")) == 1
    with pytest.raises(ConfigError, match=r" quads\[0\] "):
        load_scenarios(tmp_path / "translated.ini", "Heir")


LINES = {
    "mobility": "*.node{n}.mobility.speed = {n}mps",
    "unknown": "*.node{n}.unknown{n} = {n}",
    "anywhere": "**.node{n}.mobility.speed = {n}mps",
    "geographic": "*.node{n}.mobility.homeLatitude = 0deg\n"
    '*.node{n}.mobility.coordinateSystemModule = "coordinateSystem"',
    "protocol": '*.node{n}.protocol.protocolFileName = "quiet"\n*.node{n}.protocol.protocolMobile = "Quiet"',
    "application": '*.node{n}.app[0].typename = "UdpBasicApp"\n*.node{n}.app[0].destAddresses = "node{n}"',
    "undefined": "*.node{n}.mobility.speed = ${{s{n}}}mps",
    "variables": "*.node{n}.mobility.speed = ${{s{n}=1, 2}}mps\n*.node{n}.mobility.initialX = ${{s{n}}}m",
    "left to the user": "*.node{n}.mobility.speed = ${{s{n}=1, 2 ! s{m}}}mps",
}


@pytest.mark.parametrize("lines", LINES.values(), ids=LINES)
def test_the_time_is_proportional_to_the_number_of_lines(translated: Translated, lines: str) -> None:
    numbers = itertools.count(10_000)  # other names each time, since patterns are cached

    def calls(count: int) -> int:
        every = "\n".join(lines.format(n=n, m=n + 1) for n in itertools.islice(numbers, count))
        return count_calls(lambda: translated(f"[General]\nnetwork = GradysNetwork\n{every}\n"))

    _, first, second, third = calls(1), calls(50), calls(100), calls(150)
    assert third - second < 1.04 * (second - first)
