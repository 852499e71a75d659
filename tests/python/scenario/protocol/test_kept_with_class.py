"""What is worked out from a class goes with it."""

import gc
from pathlib import Path
from weakref import ref

from gradysim.scenario import load_scenarios
from gradysim.scenario.protocol.kept_with_class import kept_with_class
from gradysim.scenario.protocol.parametrize import parametrize
from python.quiet_protocol import QUIET


def test_it_is_worked_out_once() -> None:
    asked = []

    @kept_with_class
    def name_of(cls: type) -> str:
        asked.append(cls)
        return cls.__name__

    assert [name_of(int), name_of(str), name_of(int)] == ["int", "str", "int"]
    assert asked == [int, str]


def test_a_protocol_is_gone_once_its_file_is_loaded_anew(tmp_path: Path) -> None:
    (tmp_path / "protocol.py").write_text(f"{QUIET}\n    jitter = 0.0\n")
    file = tmp_path / "test.ini"
    file.write_text(
        'sim-time-limit = 1s\n*.node.protocol.class = "protocol.py:Quiet"\n*.node.protocol.jitter = 1s\n'
    )
    protocols = []
    for _ in range(3):
        (scenario,) = load_scenarios(file)
        (spec,) = scenario.nodes
        parametrize(spec.protocol, spec.protocol_parameters)
        protocols.append(ref(spec.protocol))
    gc.collect()
    assert [protocol() for protocol in protocols] == [None, None, spec.protocol]
