import pickle
from collections.abc import Callable
from typing import Any

import pytest

from gradysim.scenario import ConfigError, load_scenarios
from gradysim.scenario.build import networks
from gradysim.scenario.build.networks import build_network
from gradysim.scenario.errors import OF_SCRIPT, ConfigErrors
from gradysim.scenario.load import Study
from gradysim.scenario.resolve.unknown_keys import NoSuchNodeError
from gradysim.scenario.scenario import CommunicationMediumSpec, Scenario
from python.calls import count_calls
from python.scenario.conftest import BASE
from python.thorough import some


def test_a_run_holds_what_the_file_says(folder: Any) -> None:
    scenario = folder.load('[X]\ndescription = "Two UAVs"\nseed-set = 7\nsim-time-limit = 1h 30min\n', "X")
    assert (scenario.file, scenario.config, scenario.run_number) == (folder.ini, "X", 0)
    assert (scenario.seed, scenario.description, scenario.sim_time_limit_s) == (
        7,
        "Two UAVs",
        5400.0,
    )


def test_defaults(folder: Any) -> None:
    scenario = folder.load()
    assert (scenario.seed, scenario.description, scenario.medium) == (0, "", {})
    assert scenario.communication_medium == CommunicationMediumSpec()
    assert scenario.reference_coordinates == (0.0, 0.0, 0.0)


def test_a_description_needs_no_quotes(folder: Any) -> None:
    assert folder.load("description = Two UAVs # really\n").description == "Two UAVs"


def test_own_section_bases_and_general_in_that_order(folder: Any) -> None:
    added = "[A]\nextends = B\nseed-set = 1\n[B]\nseed-set = 2\n*.numUavs = 5\n"
    scenario = folder.load(added, "A")
    assert (scenario.seed, len(scenario.nodes), scenario.sim_time_limit_s) == (
        1,
        6,
        3600.0,
    )


def test_overrides_come_before_all(folder: Any) -> None:
    scenario = folder.load("", "General", "*.numUavs=1", "sim-time-limit=10s", "sim-time-limit=20s")
    assert (len(scenario.nodes), scenario.sim_time_limit_s) == (2, 10.0)


def test_a_class_on_the_command_line_needs_no_quotes(folder: Any) -> None:
    scenario = folder.load("", "General", "*.uavs[*].protocol.class=protocols.py:Sensor")
    assert [node.protocol.__name__ for node in scenario.nodes] == [
        "Sensor",
        "Sensor",
        "Sensor",
    ]


def test_one_scenario_for_each_run(folder: Any) -> None:
    folder.load("repeat = 3\n")
    scenarios = load_scenarios(str(folder.ini))
    assert [(scenario.run_number, scenario.seed) for scenario in scenarios] == [
        (0, 0),
        (1, 1),
        (2, 2),
    ]
    assert scenarios[0].nodes is scenarios[2].nodes
    assert [scenario.run_number for scenario in load_scenarios(folder.ini, runs="1..2")] == [1, 2]


def test_values_may_depend_on_the_run(folder: Any) -> None:
    folder.load('repeat = 2\nseed-set = 10${runnumber}\n**.label = "${configname}-${repetition}"\n')
    scenarios = load_scenarios(folder.ini)
    assert [scenario.seed for scenario in scenarios] == [100, 101]
    assert [scenario.nodes[1].protocol_parameters["label"] for scenario in scenarios] == [
        "General-0",
        "General-1",
    ]
    assert scenarios[0].nodes[1].protocol is scenarios[1].nodes[1].protocol


def test_a_variable_in_the_name_of_the_network_is_an_error_at_its_line(folder: Any) -> None:
    error = folder.mistake('network = ${x=A, B}\n**.label = "${x}"\n')
    assert (error.line, error.key, error.value) == (6, "network", "${x=A, B}")


def speeds(scenarios: list[Scenario]) -> list[object]:
    return [scenario.nodes[1].mobility["speed_mps"].value for scenario in scenarios]


def test_a_run_for_each_combination_of_values_and_repetition(folder: Any) -> None:
    folder.load("repeat = 2\n*.uavs[*].mobility.speed = ${speed=1, 2}mps\n")
    scenarios = load_scenarios(folder.ini)
    assert [scenario.run_number for scenario in scenarios] == [0, 1, 2, 3]
    assert [scenario.seed for scenario in scenarios] == [0, 1, 2, 3]
    assert [scenario.repetition for scenario in scenarios] == [0, 1, 0, 1]
    assert {scenario.run_count for scenario in scenarios} == {4}
    assert [scenario.iterations["speed"] for scenario in scenarios] == ["1", "1", "2", "2"]
    assert speeds(scenarios) == [1.0, 1.0, 2.0, 2.0]
    assert scenarios[0].nodes is scenarios[1].nodes
    assert speeds(load_scenarios(folder.ini, runs="2")) == [2.0]


@pytest.mark.parametrize(
    ("order", "indices"), [("x,repetition", [[0, 1, 2], [3, 4, 5]]), ("repetition,x", [[0, 2, 4], [1, 3, 5]])]
)
def test_repetitions_of_each_combination(folder: Any, order: str, indices: list[list[int]]) -> None:
    folder.load(f'repeat = 3\niteration-nesting-order = "{order}"\n**.numUavs = ${{x=1, 2}}\n')
    study = Study(folder.ini, "General", None, (), None, OF_SCRIPT)
    assert study.indices_of_repetitions() == indices


def test_options_may_iterate_too(folder: Any) -> None:
    folder.load("seed-set = ${repetition}\nrepeat = 2\n[X]\nsim-time-limit = ${10s, 20s}\n")
    assert [(scenario.sim_time_limit_s, scenario.seed) for scenario in load_scenarios(folder.ini, "X")] == [
        (10.0, 0),
        (10.0, 1),
        (20.0, 0),
        (20.0, 1),
    ]


def test_an_override_fixes_what_the_file_iterates_over(folder: Any) -> None:
    folder.load("*.uavs[*].mobility.speed = ${speed=1, 2}mps\n")
    assert speeds(load_scenarios(folder.ini, overrides=["*.uavs[*].mobility.speed=5mps"])) == [5.0]
    overrides = ["*.uavs[*].mobility.speed=${6..8}mps"]
    assert speeds(load_scenarios(folder.ini, overrides=overrides)) == [6.0, 7.0, 8.0]


def test_a_mistake_in_one_of_the_values_is_found_at_once(folder: Any) -> None:
    folder.load()
    with pytest.raises(ConfigError) as caught:
        load_scenarios(folder.ini, overrides=["**.speed=${1mps, 2s}"])
    assert caught.value.value == "${1mps, 2s}"


@pytest.mark.parametrize(
    ("key", "text", "field", "value"),
    [
        ("typename", '"UnitDiskRadioMedium"', "typename", "UnitDiskRadioMedium"),
        ("backgroundNoise.power", "-110dBm", "background_noise_w", 1e-14),
        (
            "pathLoss.typename",
            '"BreakpointPathLoss"',
            "path_loss",
            "BreakpointPathLoss",
        ),
        ("pathLoss.alpha", "2.5", "alpha", 2.5),
        ("pathLoss.breakpointDistance", "8m", "breakpoint_distance_m", 8.0),
        ("pathLoss.l01", "40.2dB", "l01_db", 40.2),
        ("pathLoss.l02", "46.2", "l02_db", 46.2),
        ("pathLoss.l02", "58.5dB", "l02_db", 58.5),
        ("pathLoss.alpha1", "2", "alpha1", 2.0),
        ("pathLoss.alpha2", "3.3", "alpha2", 3.3),
        ("pathLoss.epsilon_r", "4", "epsilon_r", 4.0),
        ("pathLoss.polarization", '"vertical"', "polarization", "vertical"),
        ("pathLoss.sigma", "2.5", "sigma_db", 2.5),
        ("pathLoss.k", "6dB", "k_db", 6.0),
        ("pathLoss.shapeFactor", "0.5", "shape_factor", 0.5),
        ("pathLoss.coherenceTime", "20ms", "coherence_time_s", 0.02),
        ("pathLoss.coherenceTime", "-1s", "coherence_time_s", -1.0),
        ("shadowing.standardDeviation", "4dB", "shadowing_standard_deviation_db", 4.0),
        ("shadowing.decorrelationTime", "500ms", "shadowing_decorrelation_time_s", 0.5),
        (
            "propagation.typename",
            '"ConstantSpeedPropagation"',
            "propagation",
            "ConstantSpeedPropagation",
        ),
    ],
)
def test_keys_of_the_medium(folder: Any, key: str, text: str, field: str, value: object) -> None:
    setting = folder.load(f"*.radioMedium.{key} = {text}\n").medium[field]
    assert (setting.value, setting.source.line) == (value, 6)


def test_prototype_modes_medium(folder: Any) -> None:
    scenario = folder.load(
        "*.communicationMedium.transmissionRange = 50m\n*.communicationMedium.delay = 5ms\n"
        "*.communicationMedium.failureRate = 0.25\n"
    )
    medium = scenario.communication_medium
    assert (medium.transmission_range_m, medium.delay_s, medium.failure_rate) == (50, 0.005, 0.25)
    assert medium.range_source.line == 6


def test_the_place_on_earth(folder: Any) -> None:
    scenario = folder.load(
        "*.coordinateSystem.sceneLatitude = -22.9deg\n*.coordinateSystem.sceneLongitude = -43.2deg\n"
        "*.coordinateSystem.sceneAltitude = 11m\n"
    )
    assert scenario.reference_coordinates == (-22.9, -43.2, 11.0)


@pytest.mark.parametrize(
    ("added", "message"),
    [
        (
            "repeat = 0\n",
            "repeat = 0: it is out of range; expected an integer, at least 1 and at most 1000000",
        ),
        (
            "seed-set = 1.5\n",
            "seed-set = 1.5: `1.5` is not an integer; expected an integer",
        ),
        (
            "*.uavs[*].mobility.speed = ${v}mps\n",
            "*.uavs[*].mobility.speed = ${v}mps: there is no variable `v`",
        ),
        (
            "**.failureRate = 1.5\n",
            "**.failureRate = 1.5: it is out of range; expected a plain number, at least 0",
        ),
        (
            "**.sceneLatitude = 91deg\n",
            "**.sceneLatitude = 91deg: it is out of range; expected an angle such as",
        ),
        (
            "**.pathLoss.alpha = 0\n",
            "**.pathLoss.alpha = 0: it is out of range; expected a plain number, greater than 0",
        ),
        (
            "**.transmissionRange = inf m\n",
            "**.transmissionRange = inf m: `infm` is not finite; expected a length",
        ),
    ],
)
def test_errors(folder: Any, added: str, message: str) -> None:
    assert folder.error(added).startswith(f"test.ini:6: {message}")


@pytest.mark.parametrize("text", ["1", "5m", "0s", "-1s", "inf s", "nan s", "200d", "1h 5"])
def test_a_time_limit_that_is_none(folder: Any, text: str) -> None:
    error = folder.mistake(f"[X]\nsim-time-limit = {text}\n", "X")
    assert (error.line, error.key, error.value) == (7, "sim-time-limit", text)
    assert all(part in error.expected for part in (" 0s ", " 9200000s"))


def test_a_time_limit_is_needed(folder: Any) -> None:
    error = folder.mistake("[X]\nsim-time-limit = default\n", "X")
    assert (error.line, error.expected) == (6, "`sim-time-limit = 1h`")


def test_all_errors_are_reported_at_once(folder: Any) -> None:
    error = folder.mistake(
        "*.uavs[*].mobility.speed = fast\n"
        "*.uavs[*].mobility.initialX = 3s\n"
        "*.uavs[*].protocol.retries = 1.5\n"
        "**.radio.transmitter.powr = 1mW\n"
        "*.uavs[0].wlan[*].bitrate = 1m\n"
        "*.radioMedium.pathLoss.alpha = x\n"
        "sim-time-limt = 3s\n"
        '*.uavs[*].mobility.typename = "MaslessMobility"\n'
    )
    assert isinstance(error, ConfigErrors)
    assert [each.line for each in error.errors] == [6, 7, 8, 9, 10, 11, 12, 13]
    assert [each.suggestion for each in error.errors][-2:] == ["sim-time-limit", "MasslessMobility"]


def test_errors_of_iterations_and_options_do_not_hide_those_of_values(folder: Any) -> None:
    error = folder.mistake(
        "*.uavs[*].mobility.speed = ${v=1..}mps\n"
        "repeat = -1\n"
        "*.uavs[*].mobility.initialX = 3s\n"
        "vector-record-interval = 3x\n"
        "**.radio.transmitter.powr = 1mW\n"
    )
    assert isinstance(error, ConfigErrors)
    assert [each.line for each in error.errors] == [6, 7, 8, 9, 10]


def test_lines_about_nodes_that_an_error_leaves_out_are_not_reported(folder: Any) -> None:
    error = folder.mistake("*.numScouts = ${n=1..}\n*.scouts[*].mobility.speed = 3mps\n")
    assert (type(error), error.line) == (ConfigError, 6)


def test_each_line_is_reported_once_for_all_nodes_and_runs(folder: Any) -> None:
    folder.load()
    folder.ini.write_text(
        folder.ini.read_text() + "repeat = 3\n**.speed = ${v=1mps, 2mps}\n*.*.mobility.initialX = -x\n"
    )
    with pytest.raises(ConfigError) as caught:
        load_scenarios(folder.ini)
    assert (type(caught.value), caught.value.line) == (ConfigError, 8)


def test_errors_of_all_combinations_are_reported(folder: Any) -> None:
    folder.write("test.ini", 'sim-time-limit = ${t=1s, 2m}\n*.a.protocol.class = ${c="x.py:A", "y.py:B"}\n')
    with pytest.raises(ConfigErrors) as caught:
        load_scenarios(folder.ini)
    assert [each.line for each in caught.value.errors] == [1, 2]


def test_a_misspelled_group_is_reported_without_what_follows_from_it(folder: Any) -> None:
    folder.write(
        "test.ini",
        'sim-time-limit = 1s\n*.numUavs = 2\n*.uvas[*].protocol.class = "protocols.py:Mobile"\n*.x.y = 1\n',
    )
    with pytest.raises(ConfigErrors) as caught:
        load_scenarios(folder.ini)
    assert [each.line for each in caught.value.errors] == [3, 4]


def test_nodes_are_needed(folder: Any) -> None:
    folder.write("test.ini", "[General]\nsim-time-limit = 1s\n[X]\n")
    with pytest.raises(ConfigError) as caught:
        load_scenarios(folder.ini)
    assert (caught.value.file, caught.value.line) == (folder.ini, 1)
    assert "`*.numUavs = 2`" in caught.value.expected
    assert caught.value.hint.endswith("`config = NAME`, X")


@pytest.mark.parametrize("size", ["0", "${n=0, 2}"])
def test_groups_without_nodes_are_told_at_the_line_of_the_first(folder: Any, size: str) -> None:
    folder.write("test.ini", f"sim-time-limit = 1s\n*.numUavs = {size}\n*.sensors.count = 0\n")
    with pytest.raises(ConfigError) as caught:
        load_scenarios(folder.ini)
    assert (caught.value.line, caught.value.value) == (2, size)


def test_keys_of_nodes_without_any_are_told_the_same(folder: Any) -> None:
    folder.write("test.ini", '[General]\nsim-time-limit = 1s\n**.protocol.class = "protocols.py:Sensor"\n')
    with pytest.raises(ConfigError) as caught:
        load_scenarios(folder.ini)
    assert (caught.value.line, caught.value.expected) == (1, "some, such as `*.numUavs = 2`")


def test_a_misspelt_general_is_named(folder: Any) -> None:
    folder.write("test.ini", "[Genral]\nsim-time-limit = 1s\n*.numUavs = 2\n[Config X]\n")
    for config in ["General", "X"]:
        with pytest.raises(ConfigErrors) as caught:
            load_scenarios(folder.ini, config)
        assert any("[General]" in error.hint for error in caught.value.errors)


def test_nodes_that_only_other_configurations_have(folder: Any) -> None:
    folder.write("test.ini", '[General]\n*.uavs[*].protocol.class = "a.py:A"\n[Ten]\n*.numUavs = 10\n')
    with pytest.raises(ConfigErrors) as caught:
        load_scenarios(folder.ini)
    *_, error = caught.value.errors
    assert isinstance(error, NoSuchNodeError)
    assert error.hint.endswith("`config = NAME`, Ten")


def test_what_is_no_name_of_a_configuration(folder: Any) -> None:
    with pytest.raises(TypeError, match=r"^config .*None: "):
        load_scenarios(folder.ini, None)  # type: ignore[arg-type]


def test_a_run_that_does_not_exist(folder: Any) -> None:
    folder.load("repeat = 3\n")
    with pytest.raises(ConfigError) as caught:
        load_scenarios(folder.ini, runs="3")
    assert (caught.value.file, caught.value.line) == (folder.ini, 6)
    assert all(part in caught.value.problem for part in ("`General`", "run 3"))
    assert caught.value.expected == "runs 0 to 2 (`repeat = 3`)"


def test_ids_count_from_the_most_general_section_on(folder: Any) -> None:
    sections = "".join(
        f'[{name}]\n*.{name.lower()}.count = 1\n**.protocol.class = "protocols.py:Sensor"\n'
        for name in ("Near", "Far", "Own")
    )
    nodes = folder.load(f"{sections}extends = Near, Far\n", "Own", "*.last.count=1", "*.own.count=1").nodes
    assert [node.group for node in nodes] == ["groundStation", "uavs", "uavs", "far", "near", "own", "last"]


def test_settings_can_be_pickled(folder: Any) -> None:
    node = folder.load("**.power = 1mW\n").nodes[0]
    assert pickle.loads(pickle.dumps(node.wlan)) == node.wlan


@pytest.mark.parametrize(
    ("head", "of_each"),
    [
        (
            "*.environment.numObstacles = {}\n",
            "*.environment.obstacle[{0}].minX = {0}m\n*.environment.obstacle[{0}].maxX = {0}.5m\n"
            "**.obstacle[{0}].minY = 0m\n**.environment.obstacle[{0}].maxY = 1m\n"
            "*.environment.obstacle[{0}].minZ = 0m\n*.environment.obstacle[{0}].maxZ = 1m\n",
        ),
        ("*.numUavs = {}\n", "**.uavs[{}].wlan[*].radio.transmitter.power = 1mW\n"),
        ("**.speed = 3mps\n", '*.g{0}[*].protocol.class = "protocols.py:Sensor"\n*.g{0}.count = 1\n'),
    ],
)
def test_twice_the_lines_take_twice_the_time(
    folder: Any, count_matches: Callable[..., int], head: str, of_each: str
) -> None:
    def load(size: int) -> None:
        lines = head.format(size) + "".join(of_each.format(index) for index in range(size))
        folder.write("test.ini", f"[General]\n{lines}" + BASE.partition("\n")[2])
        load_scenarios(folder.ini)

    few, many = (count_matches(lambda size=size: load(size)) for size in (60, 120))
    assert many <= 2.2 * few


def test_errors_of_all_parts_of_a_file_are_reported_at_once(folder: Any) -> None:
    error = folder.mistake(
        "seed-set = x\n*.uavs[*].mobility.speed = fast\n*.boats.protocol.class = 3\n"
        "*.groundStation.numWlanInterfaces = 0\n*.environment.numObstacles = many\n"
        "*.uavs[7].mobility.speed = 1mps\n",
        "General",
        "*.numUavs=-1",
        "sim-time-limit=3m",
    )
    assert [(each.line, each.key) for each in error.errors] == [
        (0, "sim-time-limit"),
        (0, "*.numUavs"),
        (6, "seed-set"),
        (7, "*.uavs[*].mobility.speed"),
        (8, "*.boats.protocol.class"),
        (9, "*.groundStation.numWlanInterfaces"),
        (10, "*.environment.numObstacles"),
    ]


PLACES = "repeat = 5\n*.uavs[*].mobility.initialX = uniform(0m, 1km)\n"


def checked(folder: Any, added: str) -> Study:
    folder.write("test.ini", BASE + added)
    return Study(folder.ini, "General", None, (), None, OF_SCRIPT)


@pytest.mark.parametrize(
    ("added", "count"),
    [
        (PLACES, 1),
        (PLACES + "*.uavs[*].mobility.speed = ${1mps, 2mps}\n", 2),
        ("repeat = 5\n*.uavs[*].mobility.speed = uniform(1mps, 2mps)\n", 5),
    ],
)
def test_runs_whose_nodes_only_stand_elsewhere_are_checked_once(
    folder: Any, monkeypatch: pytest.MonkeyPatch, added: str, count: int
) -> None:
    read: list[object] = []
    monkeypatch.setattr(networks, "build_network", lambda *given: read.append(given) or build_network(*given))
    assert len(checked(folder, added).checked_in_full()) == len(read) == count


def test_they_are_placed_where_they_stand_if_read_alone(folder: Any) -> None:
    def positions(scenario: Scenario) -> list[tuple[float, float, float]]:
        return [node.initial_position for node in scenario.nodes]

    study = checked(folder, PLACES)
    alone = [positions(load_scenarios(folder.ini, runs=str(number))[0]) for number in range(5)]
    assert list(map(positions, study)) == alone
    assert [positions(scenario) for scenario in load_scenarios(folder.ini)] == alone
    assert len(set(map(str, alone))) == 5


def test_what_only_the_seed_of_a_later_run_makes_wrong_is_refused(folder: Any) -> None:
    with pytest.raises(ConfigError, match="seed 4: "):
        checked(folder, "repeat = 50\n*.uavs[*].mobility.speed = uniform(-1mps, 20mps)\n")


THREE_SWEEPS = (
    "*.uavs[*].mobility.speed = ${speed=1..20}mps\n"
    "*.uavs[*].protocol.heartbeat_jitter = ${jitter=1..20}\n"
    "*.uavs[*].mobility.lineStepX = ${step=1..20}m\n"
)


def networks_read(monkeypatch: pytest.MonkeyPatch) -> list[object]:
    """Return a list that grows by one element for each network that is read."""
    read: list[object] = []
    monkeypatch.setattr(networks, "build_network", lambda *given: read.append(given) or build_network(*given))
    return read


def test_a_large_study_reads_each_value_once_and_scenarios_when_they_are_asked_for(
    folder: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    read = networks_read(monkeypatch)
    study = checked(folder, THREE_SWEEPS + "repeat = 10\n")
    assert (len(study), len(read)) == (80_000, 100 + 15 + 19)
    speeds = {str(each.nodes[1].mobility["speed_mps"].value) for each in study.checked_in_full()}
    assert len(speeds) == 20
    last = study[-1]
    assert (last.run_number, last.repetition, last.seed) == (79_999, 9, 79_999)
    assert dict(last.iterations) == {"speed": "20", "jitter": "20", "step": "20"}
    assert (len(read), last.nodes[2].initial_position) == (100 + 15 + 19 + 1, (20.0, 0.0, 0.0))


def test_the_runs_of_a_large_study_are_those_that_are_read_alone(folder: Any) -> None:
    study = checked(folder, THREE_SWEEPS + "*.uavs[*].mobility.initialZ = uniform(0m, 9m)\n")
    for number in (0, 99, 100, 4321, 7999):
        alone = load_scenarios(folder.ini, runs=[number])[0]
        assert repr(study[number]) == repr(alone)
        assert study[number].settings_hash == alone.settings_hash


@pytest.mark.parametrize("place", some([499, 0, 150, 350]))
def test_a_wrong_value_is_found_wherever_it_stands_in_a_sweep(folder: Any, place: int) -> None:
    speeds = [f"{speed}mps" for speed in range(1, 501)]
    speeds[place] = "3s"
    with pytest.raises(ConfigError) as caught:
        checked(folder, f"*.uavs[*].mobility.speed = ${{{', '.join(speeds)}}}\n")
    assert (caught.value.line, caught.value.key) == (6, "*.uavs[*].mobility.speed")


@pytest.mark.parametrize(
    "added",
    [
        'description = "run ${{x=1..{0}}} of {0}"\n',
        "description = run ${{x=1..{}}} of many\n",
        'description = "${{iterationvars}}"\nexperiment-label = ${{x=1..{}}}\n',
    ],
)
def test_descriptions_are_not_read_before_their_runs_if_all_are_right(folder: Any, added: str) -> None:
    few, many = (count_calls(lambda size=size: checked(folder, added.format(size))) for size in (1000, 2000))
    assert many - few < 20 * 1000


@pytest.mark.parametrize(
    "text",
    ['"is ${x=1, 2, "3"}"', '${x=1, 2, "3" "4"}', '"is" + ${x="1", "2", 3}'],
)
def test_a_description_that_a_value_makes_wrong_is_found(folder: Any, text: str) -> None:
    with pytest.raises(ConfigError) as caught:
        checked(folder, f"description = {text}\n")
    assert (caught.value.line, caught.value.key) == (6, "description")


def test_a_description_that_the_values_make_too_long_is_found(folder: Any) -> None:
    with pytest.raises(ConfigError) as caught:
        checked(folder, f"description = ${{x=1, {'9' * 100_000}}}{'${x}' * 200}\n")
    assert (caught.value.line, caught.value.key) == (6, "description")


def test_all_wrong_values_of_several_sweeps_are_found_before_the_first_run(folder: Any) -> None:
    with pytest.raises(ConfigErrors) as caught:
        checked(folder, THREE_SWEEPS.replace("20}mps", "20, -9}mps").replace("20}m\n", "20, 1e30}m\n"))
    assert {error.line for error in caught.value.errors} == {6, 8}


def test_all_choices_of_nodes_and_protocols_are_combined(folder: Any) -> None:
    choices = (
        '*.uavs[2].protocol.class = ${class="protocols.py:Mobile", "protocols.py:Sensor"}\n'
        "*.numUavs = ${n=1..3}\n"
        "*.uavs[2].protocol.retries = 1\n"  # Sensor does not have this parameter
    )
    lines = BASE.replace("*.numUavs = 2\n", "").splitlines(keepends=True)
    folder.write("test.ini", "".join([*lines[:-1], choices, lines[-1], THREE_SWEEPS]))
    with pytest.raises(ConfigError) as caught:
        Study(folder.ini, "General", None, (), None, OF_SCRIPT)
    assert (caught.value.line, caught.value.key) == (6, "*.uavs[2].protocol.retries")


def test_what_only_a_combination_makes_wrong_is_found_before_it_runs(folder: Any) -> None:
    study = checked(
        folder,
        "*.uavs[*].mobility.lineStartX = ${start=1..20}00000m * 4\n"
        "*.uavs[*].mobility.lineStepX = ${step=1..20}00000m * 3\n",
    )
    with pytest.raises(ConfigError) as caught:
        study[-1]
    assert caught.value.line == 7


@pytest.mark.parametrize(
    ("seed", "equal"),
    [
        ("5", True),
        ("${runnumber}", False),
        ("${repetition}", False),
        ("10 - ${repetition}", False),
        ("${repetition} * 0", True),
        ("${repetition} % 2", True),
    ],
)
def test_runs_are_equal_if_all_but_their_number_is(folder: Any, seed: str, equal: bool) -> None:
    study = checked(folder, f"repeat = 3\n*.uavs[*].mobility.speed = ${{1, 2}}mps\nseed-set = {seed}\n")
    assert study.has_equal_runs() is equal
    assert [scenario.seed for scenario in study] == list(study.seeds)
