"""Lint checks: lines that are valid but probably not intended."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.prototype.run import PrototypeRun
from gradysim.scenario import load_scenarios
from gradysim.scenario.lint import (
    Finding,
    _unit_other_than_time,
    bands_beside_frequencies,
    by_line,
    doubtful_times,
    lint,
    nodes_on_one_point,
    shadowed_lines,
    unread_variables,
)
from gradysim.scenario.parse.ini import read_ini
from gradysim.scenario.parse.sections import search_order
from python.scenario.conftest import BASE

Write = Callable[..., Path]


def shadowed(file: Path, config: str = "General") -> list[Finding]:
    return shadowed_lines(search_order(read_ini(file), config))


def test_a_special_line_below_a_general_one_has_no_effect(write_ini: Write) -> None:
    file = write_ini("*.uavs[*].mobility.speed = 3mps\n*.uavs[1].mobility.speed = 5mps\n")
    (finding,) = shadowed(file)
    assert (finding.file, finding.line, finding.key) == (file, 2, "*.uavs[1].mobility.speed")
    assert "line 1, `*.uavs[*].mobility.speed`," in finding.message
    assert str(finding) == f"{file}:2: warning: {finding.message}"


def test_findings_are_sorted_by_line_and_not_repeated(folder: Any) -> None:
    folder.write(
        "test.ini", BASE + "repeat = 2\n**.speed = 3mps\n*.uavs[0].mobility.speed = 5mps\nrepeat = 3\n"
    )
    findings = lint(load_scenarios(folder.ini))
    assert [finding.line for finding in findings] == [8, 9]
    assert by_line(reversed([*findings, *findings])) == findings


@pytest.mark.parametrize(
    ("above", "below"),
    [
        ("*.numUavs", "*.numUavs"),
        ("repeat", "repeat"),
        ("**.speed", "*.uavs[0].mobility.speed"),
        ("**.speed", "*.uavs[*].**.speed"),
        ("**.mobility.*", "**.mobility.speed"),
        ("*.*.mobility.speed", "*.uavs[0..3].mobility.speed"),
        ("*.uavs[*].mobility.speed", "*.uavs[0..3].mobility.speed"),
        ("*.uavs[0..3].mobility.speed", "*.uavs[2].mobility.speed"),
        ("**.wlan[*].bitrate", "*.uavs[*].wlan[0].bitrate"),
        ("*.uavs[*].mobility.initialX", "*.uavs[*].mobility.lineStepX"),
        ("*.uavs[*].mobility.lineStepY", "*.uavs[0].mobility.initialY"),
        ("*.uav.mobility.initialZ", "*.uav.mobility.lineStartZ"),
        ("*.uavs[*].mobility.separationX", "*.uavs[0].mobility.initialX"),
        ("*.uavs[*].mobility.lineStepY", "*.uavs[*].mobility.separationY"),
        ("*.uavs[*].mobility.lineStartX", "*.uavs[*].mobility.separationX"),
        ("*.uavs[*].mobility.initialY", "*.uavs[0].mobility.separationY"),
        ("*.uavs[*].mobility.separationY", "*.uavs[*].mobility.lineStartY"),
        ("*.uavs[*].mobility.separationX", "*.uavs[0].mobility.lineStepX"),
        ("**.radio.centerFrequency", "*.uavs[0].wlan[0].radio.channelNumber"),
        ("**.radio.channelNumber", "*.uavs[0].wlan[0].radio.centerFrequency"),
        ("*.numUavs", "*.uavs.count"),
        ("*.uavs.count", "*.numUavs"),
        ("*.uavs[*].protocol.class", "*.uavs[*].protocol.typename"),
        ("*.uavs[*].protocol.typename", "*.uavs[0].protocol.class"),
        ("*.uav.wlan[*].radio.transmitter.power", "*.uav.wlan[*].radio.transmitter.communicationRange"),
        ("*.uav.wlan[*].radio.transmitter.communicationRange", "*.uav.wlan[0].radio.transmitter.power"),
        ("**.transmitter.power", "*.uav.wlan[*].radio.transmitter.power"),
        ("**.communicationRange", "**.transmitter.power"),
        ("**.transmitter.power", "**.communicationRange"),
    ],
)
def test_lines_without_effect(write_ini: Write, above: str, below: str) -> None:
    (finding,) = shadowed(write_ini(f"{above} = 1\n{below} = 2\n"))
    assert (finding.key, finding.line) == (below, 2)
    assert f"line 1, `{above}`," in finding.message


@pytest.mark.parametrize(
    ("above", "below"),
    [
        ("*.numUavs", "*.sensors.count"),
        ("*.uavs[0].protocol.class", "*.uavs[*].protocol.typename"),
        ("*.uavs[1].mobility.speed", "*.uavs[*].mobility.speed"),
        ("*.uavs[*].mobility.speed", "**.speed"),
        ("*.uavs[*].mobility.speed", "*.*.mobility.speed"),
        ("*.uavs[0..3].mobility.speed", "*.uavs[2..5].mobility.speed"),
        ("*.uavs[0..3].mobility.speed", "*.uavs[4].mobility.speed"),
        ("*.*.speed", "**.speed"),
        ("*.uavs[0].mobility.speed", "*.uavs[1].mobility.speed"),
        ("*.uavs[*].mobility.lineStartX", "*.uavs[*].mobility.lineStepX"),
        ("*.uavs[*].mobility.initialX", "*.uavs[*].mobility.lineStepY"),
        ("*.uavs[0].mobility.initialX", "*.uavs[*].mobility.lineStepX"),
        (
            "*.uavs[0].wlan[*].radio.transmitter.power",
            "*.uavs[*].wlan[*].radio.transmitter.communicationRange",
        ),
        ("**.communicationRange", "*.radioMedium.backgroundNoise.power"),
        ("cmdenv-status-frequency", "cmdenv-status-frequency"),
    ],
)
def test_lines_with_an_effect(write_ini: Write, above: str, below: str) -> None:
    assert shadowed(write_ini(f"{above} = 1\n{below} = 2\n")) == []


@pytest.mark.parametrize(
    ("above", "below"),
    [("*.numUavs", "*.numUavs"), ("*.uavs[0].mobility.initialX", "*.uavs[0].mobility.lineStepX")],
)
def test_of_lines_that_set_the_same_thing_one_is_expected(write_ini: Write, above: str, below: str) -> None:
    (finding,) = shadowed(write_ini(f"{above} = 1\n{below} = 2\n"))
    assert finding.message.endswith(" them")


def test_a_line_without_effect_shadows_no_other(write_ini: Write) -> None:
    file = write_ini("**.lineStartX = 1m\n**.initialX = 1m\n**.lineStepX = 1m\n")
    (finding,) = shadowed(file)
    assert finding.line == 2


def test_a_line_that_says_the_same_does_no_harm(write_ini: Write) -> None:
    file = write_ini("*.uavs[*].mobility.speed = 3mps\n*.uavs[1].mobility.speed = 3mps\n")
    assert shadowed(file) == []


@pytest.mark.parametrize("lines", [["*.numUavs", "*.uavs.count"], ["*.uavs.count", "*.numUavs"]])
def test_two_equal_counts_of_a_group_do_no_harm(write_ini: Write, lines: list[str]) -> None:
    assert shadowed(write_ini("".join(f"{line} = 2\n" for line in lines))) == []


def test_another_section_and_an_included_file_are_there_to_be_overridden(write_ini: Write) -> None:
    write_ini("**.speed = 1mps\n", "base.ini")
    file = write_ini("**.speed = 2mps\ninclude base.ini\n[Config A]\n**.speed = 3mps\n")
    assert shadowed(file, "A") == []


def test_only_sections_of_the_configuration_are_looked_at(write_ini: Write) -> None:
    file = write_ini("[Config A]\nrepeat = 2\n[Config B]\nrepeat = 2\nrepeat = 3\n")
    assert shadowed(file, "A") == []
    assert len(shadowed(file, "B")) == 1


POWER_AND_RANGE = ["**.transmitter.power = {}\n", "**.transmitter.communicationRange = {}\n"]


@pytest.mark.parametrize("lines", [POWER_AND_RANGE, POWER_AND_RANGE[::-1]])
def test_a_range_shadows_no_power_where_there_are_none(write_ini: Write, lines: list[str]) -> None:
    sections = search_order(read_ini(write_ini("".join(lines).format("1mW", "2m"))), "General")
    assert shadowed_lines(sections, has_powers=False) == []


@pytest.mark.parametrize("lines", [POWER_AND_RANGE, POWER_AND_RANGE[::-1]])
def test_a_default_shadows_no_line_by_another_key(write_ini: Write, lines: list[str]) -> None:
    assert shadowed(write_ini("".join(lines).format("default", "2"))) == []


def test_a_default_shadows_the_same_key(write_ini: Write) -> None:
    power, _ = POWER_AND_RANGE
    (finding,) = shadowed(write_ini(power.format("default") + power.format("1mW")))
    assert finding.line == 2


def test_a_range_in_another_section_overrides_a_power(write_ini: Write) -> None:
    power, reach = (line.format("2") for line in POWER_AND_RANGE)
    assert shadowed(write_ini(f"[General]\n{power}[Config X]\n{reach}"), "X") == []


@pytest.mark.parametrize(
    "line", ["**.uavs[{}].wlan[*].radio.power = 1mW\n", "*.g{}[*].mobility.speed = 3mps\n"]
)
def test_general_lines_about_other_nodes_are_not_compared(
    write_ini: Write, count_matches: Callable[..., int], line: str
) -> None:
    lines = "".join(line.format(index) for index in range(50))
    assert count_matches(lambda: shadowed(write_ini(lines + line.format(7)))) <= 1


BAND = '**.radio.bandName = "5 GHz"\n'
CENTER = "**.radio.centerFrequency = 2.412GHz\n"
CHANNEL = "**.radio.channelNumber = 3\n"


def bands(folder: Any, added: str, config: str = "General", *overrides: str) -> list[Finding]:
    return bands_beside_frequencies(folder.load(added, config, *overrides).nodes)


@pytest.mark.parametrize(("lines", "band", "center"), [(BAND + CENTER, 6, 7), (CENTER + BAND, 7, 6)])
def test_a_band_beside_a_frequency_has_no_effect_whichever_comes_first(
    folder: Any, lines: str, band: int, center: int
) -> None:
    (finding,) = bands(folder, lines)
    assert (finding.line, finding.key) == (band, "**.radio.bandName")
    assert f"line {center}, `**.radio.centerFrequency`," in finding.message


def test_a_channel_that_comes_after_the_frequency_counts_in_no_band(folder: Any) -> None:
    assert len(bands(folder, CENTER + CHANNEL + BAND)) == 1


@pytest.mark.parametrize(
    "lines",
    [
        BAND,
        CENTER,
        BAND + CHANNEL,
        BAND + CHANNEL + CENTER,
        CHANNEL + CENTER + BAND,
        BAND + CENTER.replace("2.412GHz", "default"),
        BAND.replace('"5 GHz"', "default") + CENTER,
        "*.uavs[0].wlan[0]" + CENTER.removeprefix("**") + BAND,
        "*.uavs[0].wlan[0]" + CHANNEL.removeprefix("**") + CENTER + BAND,
    ],
)
def test_a_band_that_some_interface_reads_is_not_bands(folder: Any, lines: str) -> None:
    assert bands(folder, lines) == []


def test_a_section_may_override_the_band_by_a_frequency_but_not_the_other_way_round(folder: Any) -> None:
    assert bands(folder, f"{BAND}[Config A]\n{CENTER}", "A") == []
    assert len(bands(folder, f"{CENTER}[Config A]\n{BAND}", "A")) == 1


def test_a_file_that_is_included_and_a_command_line_may_be_overridden(folder: Any) -> None:
    folder.write("base.ini", BAND)
    assert bands(folder, f"{CENTER}include base.ini\n") == []
    assert bands(folder, BAND, "General", CENTER) == []


def test_the_place_of_an_override_is_its_own(folder: Any) -> None:
    (finding,) = bands(folder, CENTER, "General", BAND)
    assert finding.source.is_override
    assert f"{folder.ini}:6, `**.radio.centerFrequency`," in finding.message


TIMED = """
from typing import Annotated
from protocols import Sensor


class Timed(Sensor):
    interval = 1.0
    heartbeatTimeout = 1.0
    jitter = 0.0
    Spread = 0.0
    offset = 0.0
    position_jitter = 0.0
    spacing = 1.0
    lawn_interval: Annotated[float, "m"] = 1.0
    beacon_period: Annotated[float, "s"] = 1.0
    retries = 3
    label = ""
"""


def times(folder: Any, line: str) -> list[Finding]:
    folder.write("timed.py", TIMED)
    chosen = '[X]\n*.uavs[*].protocol.class = "timed.py:Timed"\n'
    return doubtful_times(folder.load(f"{chosen}{line}\n", "X").nodes)


FIXED = '[X]\n*.uavs[*].mobility.typename = "StationaryMobility"\n'


def test_fixed_nodes_on_one_point_are_found(folder: Any) -> None:
    (finding,) = nodes_on_one_point(folder.load(f"{FIXED}*.uavs[*].mobility.initialX = 5m\n", "X").nodes)
    assert (finding.line, finding.key) == (5, "*.uavs[*].protocol.class")
    assert all(part in finding.message for part in ("uavs[0]", "uavs[1]", "(5, 0, 0) m"))
    assert finding.message.endswith("`*.uavs[*].mobility.lineStepX = 10m`")


@pytest.mark.parametrize("added", ["[X]\n", f"{FIXED}*.uavs[*].mobility.lineStepX = 5m\n"])
def test_nodes_that_move_or_stand_apart_are_not_found(folder: Any, added: str) -> None:
    assert nodes_on_one_point(folder.load(added, "X").nodes) == []


def test_a_time_in_meters_is_found_once_with_its_line(folder: Any) -> None:
    (finding,) = times(folder, "*.uavs[*].protocol.interval = 5m")
    assert (finding.line, finding.key) == (8, "*.uavs[*].protocol.interval")
    assert "`min`" in finding.message


@pytest.mark.parametrize(
    ("value", "unit"), [("5km", "km"), ("2 * 5Hz", "Hz"), ("-3dBm", "dBm"), ("exponential(5km)", "km")]
)
def test_a_time_in_another_unit(folder: Any, value: str, unit: str) -> None:
    (finding,) = times(folder, f"*.uavs[*].protocol.interval = {value}")
    assert f"`{unit}`" in finding.message
    assert "`min`" not in finding.message


@pytest.mark.parametrize("value", ["parentIndex() == 1 ? 5m : 5s", "select(parentIndex(), 5s, 5m)"])
def test_a_time_of_one_node_alone(folder: Any, value: str) -> None:
    assert len(times(folder, f"*.uavs[*].protocol.interval = {value}")) == 1


@pytest.mark.parametrize("name", ["jitter", "Spread", "offset"])
def test_a_word_that_alone_is_a_time(folder: Any, name: str) -> None:
    (finding,) = times(folder, f"*.uavs[*].protocol.{name} = 1m")
    assert finding.key.endswith(name)


@pytest.mark.parametrize("values", ["${5m, 10m}", "${interval=10s, 5m}", "${5, 10}m", "${5..10 step 5}m"])
def test_a_list_of_values(folder: Any, values: str) -> None:
    assert len(times(folder, f"*.uavs[*].protocol.interval = {values}")) == 1


def test_each_line_is_a_finding(folder: Any) -> None:
    lines = "*.uavs[0].protocol.interval = 5m\n*.uavs[1].protocol.heartbeatTimeout = 2 * 5m"
    assert len(times(folder, lines)) == 2


@pytest.mark.parametrize(
    "line",
    [
        "interval = 5min",
        "jitter = 5min",
        "position_jitter = 5m",
        "interval = 5",
        "interval = ${runnumber}m",
        "interval = ${5min, 10ms, 1 km}",
        "interval = ${5, 10}min",
        "spacing = 5m",
        "lawn_interval = 5m",
        "beacon_period = 5",
        'label = "5m"',
        "retries = 5",
    ],
)
def test_other_quantities_are_no_finding(folder: Any, line: str) -> None:
    assert times(folder, f"*.uavs[*].protocol.{line}") == []


RTS = "**.rtsThreshold = ${rts=3000B, 100B}\n"


def unread(folder: Any, added: str, *overrides: str, config: str = "General") -> Finding:
    """Return the only finding for the base with additional lines."""
    folder.write("test.ini", BASE + added)
    scenario = load_scenarios(folder.ini, config, overrides=overrides)[-1]
    (finding,) = unread_variables(scenario.unread_variables, scenario.lines)
    return finding


def test_a_study_that_another_key_overrides(folder: Any) -> None:
    override = "**.mac.dcf.rtsPolicy.rtsThreshold=100B"
    finding = unread(folder, RTS, override)
    assert (finding.line, finding.key) == (6, "**.rtsThreshold")
    assert "$rts " in finding.message
    assert f"`override {override}`" in finding.message


def test_a_line_of_the_same_file_that_overrides_a_study(folder: Any) -> None:
    sections = '[Base]\n*.numBoats = ${boats=4, 8}\n*.boats[*].protocol.class = "protocols.py:Sensor"\n'
    finding = unread(folder, f"{sections}[Own]\nextends = Base\n*.boats.count = 2\n", config="Own")
    assert (finding.line, finding.key) == (7, "*.numBoats")
    assert "line 11, `*.boats.count`," in finding.message


def test_a_key_that_sets_the_same_thing_overrides_a_study(folder: Any) -> None:
    study = "*.uavs[*].mobility.initialX = ${1m, 2m}\n"
    finding = unread(folder, study, "**.mobility.lineStartX=5m")
    assert "`override **.mobility.lineStartX=5m`" in finding.message


def test_a_study_of_nodes_that_do_not_exist(folder: Any) -> None:
    boats = '*.numBoats = 0\n*.boats[*].protocol.class = "protocols.py:Sensor"\n'
    finding = unread(folder, f"{boats}*.boats[*].mobility.speed = ${{one=1, 2}}mps * ${{other=1, 2}}\n")
    assert finding.line == 8
    assert "$one and $other " in finding.message


SHARES = """
from collections import defaultdict, deque
from typing import ClassVar
from protocols import Sensor


class Base(Sensor):
    heard{annotation} = {value}
    period = 1.0
    label = "none"

    {code}


class Derived(Base):
    pass


class Own(Base):
    def initialize(self):
        self.heard = []
"""


def found_by_run(
    folder: Any,
    code: str,
    value: str = "[]",
    lines: str = '*.uavs[*].protocol.class = "shares.py:Base"\n*.uavs[*].protocol.period = 3s\n',
    annotation: str = "",
) -> list[Finding]:
    folder.write("shares.py", SHARES.format(code=code, value=value, annotation=annotation))
    run = PrototypeRun(folder.load(f"[X]\nsim-time-limit = 1s\n{lines}", "X"))
    run.execute()
    return run.findings()


def test_a_parameter_that_initialize_overwrites_is_found_once(folder: Any) -> None:
    (finding,) = found_by_run(folder, "def initialize(self): self.period = 5.0")
    assert (finding.line, finding.key) == (9, "*.uavs[*].protocol.period")


def test_a_parameter_that_init_overwrites(folder: Any) -> None:
    assert len(found_by_run(folder, "def __init__(self, period=5.0): self.period = period")) == 1


@pytest.mark.parametrize(
    "code",
    [
        "def initialize(self): self.other = self.period",
        "def initialize(self): self.period = 3.0",
        "def initialize(self): self.period = [self.period]",
        "def initialize(self): self.label = 'some'",
        "def finish(self): self.period = 5.0",
    ],
)
def test_parameters_that_keep_their_values_and_those_without_a_line(folder: Any, code: str) -> None:
    assert found_by_run(folder, code) == []


@pytest.mark.parametrize(
    ("code", "value"),
    [
        ("self.heard.append(1)", "[]"),
        ("self.heard += [1]", "[]"),
        ("self.heard[0] = 1.5", "[0]"),
        ("self.heard[0] = 1", "{}"),
        ("self.heard[0] += 1", "defaultdict(int)"),
        ("del self.heard[self.heard and min(self.heard)]", "{0: 1, 1: 2, 2: 3}"),
        ("self.heard.add(1)", "set()"),
        ("self.heard.append(1)", "deque()"),
    ],
)
def test_a_container_that_nodes_share_is_found_once(folder: Any, code: str, value: str) -> None:
    (finding,) = found_by_run(folder, f"def finish(self): {code}", value)
    assert finding.line == 8
    assert "`heard`" in finding.message


@pytest.mark.parametrize(
    ("code", "value"),
    [
        ("print(self.heard[0], len(self.heard))", "[1]"),
        ("self.heard += 1", "0"),
        ("self.heard = []; self.heard.append(1)", "[]"),
    ],
)
def test_a_class_body_that_no_node_changes(folder: Any, code: str, value: str) -> None:
    assert found_by_run(folder, f"def finish(self): {code}", value) == []


def test_classes_that_inherit_share_a_container(folder: Any) -> None:
    lines = (
        '*.groundStation.protocol.class = "shares.py:Base"\n'
        '*.numUavs = 1\n*.uavs[*].protocol.class = "shares.py:Derived"\n'
    )
    (finding,) = found_by_run(folder, "def finish(self): self.heard.append(1)", lines=lines)
    assert "Base" in finding.message


def test_a_class_of_one_node_shares_nothing(folder: Any) -> None:
    lines = '*.groundStation.protocol.class = "shares.py:Base"\n'
    assert found_by_run(folder, "def finish(self): self.heard.append(1)", lines=lines) == []


def test_a_class_that_makes_one_for_each_node_shares_nothing(folder: Any) -> None:
    lines = '*.uavs[*].protocol.class = "shares.py:Own"\n'
    assert found_by_run(folder, "def finish(self): self.heard.append(1)", lines=lines) == []


def test_a_class_variable_is_shared_on_purpose(folder: Any) -> None:
    code = "def finish(self): self.heard.append(1)"
    assert found_by_run(folder, code, annotation=": ClassVar[list[int]]") == []


def test_a_long_list_of_values_takes_little_time() -> None:
    text = f"${{{', '.join(map(str, range(40_000)))}}}s"
    started_s = time.process_time()
    assert _unit_other_than_time(text, "uavs[0].protocol.interval") == ""
    assert time.process_time() - started_s < 5  # it took minutes
    assert _unit_other_than_time("${5, 10}m", "uavs[0].protocol.interval") == "m"
