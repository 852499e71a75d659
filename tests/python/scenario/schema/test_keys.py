from typing import Any

from gradysim.scenario.parse.expressions import parse_list, parse_value
from gradysim.scenario.schema.engine_keys import ReadBy, engine_keys
from gradysim.scenario.schema.keys import GROUP_SIZE, NETWORK_KEYS, NODE_KEYS, OBSTACLE_KEYS, obstacle_path

ALL_KEYS = (*NODE_KEYS, *NETWORK_KEYS)


def test_models_that_read_a_key_can_be_chosen() -> None:
    choosers = {key.target: key for key in ALL_KEYS}
    for key in ALL_KEYS:
        for name in key.read_by.names if key.read_by else ():
            assert choosers[key.read_by.chosen_by].kind.convert(name) == name


def test_keys_for_one_value_are_read_by_the_same_models() -> None:
    models: dict[str, set[ReadBy | None]] = {}
    for key in ALL_KEYS:
        models.setdefault(key.target, set()).add(key.read_by)
    assert [target for target, of_target in models.items() if len(of_target) > 1] == []


def test_a_key_does_not_choose_who_reads_it() -> None:
    chosen_by = {key.target: key.read_by.chosen_by for key in ALL_KEYS if key.read_by}
    for target in chosen_by:
        seen = [target]
        while seen[-1] in chosen_by:
            assert chosen_by[seen[-1]] not in seen
            seen.append(chosen_by[seen[-1]])


def test_paths_are_unique() -> None:
    paths = [key.path for key in (*NODE_KEYS, *NETWORK_KEYS, GROUP_SIZE)]
    assert len(set(paths)) == len(paths)


def test_each_obstacle_has_its_own_paths() -> None:
    paths = {obstacle_path(key, index) for key in OBSTACLE_KEYS for index in (0, 12)}
    assert len(paths) == 2 * len(OBSTACLE_KEYS)


def test_the_interface_is_written_with_a_wildcard() -> None:
    assert next(key.written for key in NODE_KEYS if key.field == "bitrate_bps") == "wlan[*].bitrate"


def test_every_default_that_is_listed_can_be_written() -> None:
    for key in (key for keys in engine_keys().values() for key in keys):
        for value in key.defaults.values():
            shown = key.kind.show(value)
            written: Any = parse_list(shown) if key.kind.is_list else parse_value(shown)
            assert key.kind.convert(written) is not None, key.path
