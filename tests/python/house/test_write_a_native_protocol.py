"""docs/how-to/write-a-native-protocol.md is correct; its C++ program is one of the C++ tests."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")

from gradysim.integrated.run import run
from gradysim.scenario import load_scenarios
from gradysim.scenario.schema.native_protocols import native_protocols

GUIDE = "docs/how-to/write-a-native-protocol.md"
REST = """
[General]
sim-time-limit = 3s
*.numNodes = 2
*.nodes[*].mobility.lineStepX = 10m
"""


def test_its_settings_run(code_blocks: Callable[[str, str], list[str]], tmp_path: Path) -> None:
    (tmp_path / "guide.ini").write_text(REST + "\n".join(code_blocks(GUIDE, "ini")))
    (scenario,) = load_scenarios(tmp_path / "guide.ini")
    result = run(scenario)
    assert [node.tracked_variables["received"] for node in result.nodes] == [
        node.tracked_variables["sent"] for node in reversed(result.nodes)
    ]


def test_its_commands_print_one_result_hash(
    root: Path,
    code_blocks: Callable[[str, str], list[str]],
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
) -> None:
    shows(GUIDE, shell(code_blocks(GUIDE, "sh")[0], root))


def test_its_table_has_every_native_protocol(root: Path) -> None:
    rows = re.findall(r"^\| `(\w+)` \|.*\| `?([^`]*?)`? \|$", (root / GUIDE).read_text(), re.MULTILINE)
    assert dict(rows) == {name: native._python_class for name, native in native_protocols().items()}
