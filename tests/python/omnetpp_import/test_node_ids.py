"""Ids in the place of names, which have to be those of the scenario."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.omnetpp_import import Action, Translation
from gradysim.scenario import load_scenarios

NED = "network N { submodules: relay: AdhocHost; host[numHosts]: AdhocHost; sink: AdhocHost; }"
TEXT = """[Config Base]
network = N
*.host[*].app[0].typename = "UdpBasicApp"
*.host[*].app[0].destAddresses = "sink host[1]"
*.sink.app[0].typename = "UdpSink"
*.numHosts = 3
[Config Heir]
extends = Base
*.relay.mobility.initialX = 3m
"""
KEY = "*.host[*].protocol.destinations"


def destinations(translation: Translation) -> list[tuple[Action, str]]:
    return [(each.action, each.text) for each in translation.outcomes if each.text.startswith(KEY)]


@pytest.mark.parametrize("config", ["Base", "Heir"])
def test_names_become_ids(translated: Callable[..., Translation], tmp_path: Path, config: str) -> None:
    translation = translated(TEXT, NED)
    (tmp_path / "translated.ini").write_text(translation.text)
    (scenario,) = load_scenarios(tmp_path / "translated.ini", config)
    ids = {node.name: node.id for node in scenario.nodes}
    assert {"relay", "sink", "host[2]"} < ids.keys()
    expected = f"{ids['sink']} {ids['host[1]']}"
    assert destinations(translation) == [(Action.RENAMED, f'{KEY} = "{expected}"')]


@pytest.mark.parametrize(
    "changed",
    [TEXT.replace("= 3", "= ${2, 3}"), f"{TEXT}*.numHosts = 2\n", TEXT.replace("sink host", "other host")],
)
def test_ids_that_are_not_known(translated: Callable[..., Translation], changed: str) -> None:
    assert destinations(translated(changed, NED)) == [(Action.TO_WRITE, f"{KEY} = ...")]


def test_what_nodes_hear_is_not_needed(translated: Callable[..., Translation]) -> None:
    text = (
        "[General]\nnetwork = GradysNetwork\n*.numUAVs = ${1, 2}\n"
        '*.quads[*].protocol.typename = "DadcaProtocol"\n*.quads[*].app[0].destAddresses = "groundStation"\n'
    )
    line = '*.quads[*].app[0].destAddresses = "groundStation"'
    assert f": {line}  (" in translated(text).text
    assert '*.quads[*].protocol.hears = "2"\n' in translated(text.replace("${1, 2}", "1")).text
