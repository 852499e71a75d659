import ast
from pathlib import Path

from gradysim.scenario.keys import NETWORK_KEYS, NODE_KEYS
from gradysim.scenario.keys.key import ReadBy
from gradysim.scenario.keys.node import GROUP_SIZE

ALL_KEYS = (*NODE_KEYS, *NETWORK_KEYS)

STRUCTS = {
    "medium": "MediumConfig",
    "radio": "RadioConfig",
    "antenna": "AntennaConfig",
    "mac": "MacConfig",
    "csma": "CsmaConfig",
    "mobility": "MobilityConfig",
}


def fields_of_the_engine() -> set[str]:
    """ "struct.field" of all configurations, from the stub of the compiled part."""
    stub = Path(__file__).parents[4] / "python" / "gradysim" / "_netsim.pyi"
    classes = {node.name: node for node in ast.parse(stub.read_text()).body if isinstance(node, ast.ClassDef)}
    fields = set()
    for struct, name in STRUCTS.items():
        for item in classes[name].body:
            if isinstance(item, ast.AnnAssign) and isinstance(item.target, ast.Name):
                fields.add(f"{struct}.{item.target.id}")
            elif isinstance(item, ast.FunctionDef) and item.decorator_list:
                fields.add(f"{struct}.{item.name}")
    return fields


def test_targets_are_fields_of_the_engine() -> None:
    targets = {key.target for key in (*NODE_KEYS, *NETWORK_KEYS) if key.struct in STRUCTS}
    assert targets - fields_of_the_engine() == set()


def test_every_field_of_the_engine_can_be_set() -> None:
    targets = {key.target for key in (*NODE_KEYS, *NETWORK_KEYS)}
    made_of_others = {"medium.obstacles", "radio.antenna", "csma.ack_end_s"}
    assert fields_of_the_engine() - targets == made_of_others


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


def test_the_interface_is_written_with_a_wildcard() -> None:
    assert next(key.written for key in NODE_KEYS if key.field == "bitrate_bps") == "wlan[*].bitrate"
