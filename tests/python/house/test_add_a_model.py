"""The example of docs/contributing/add-a-model.md is the code of the engine."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.scenario import ConfigError, load_scenarios

GUIDE = "docs/contributing/add-a-model.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.fixture
def scenario_file(tmp_path: Path, code_blocks: CodeBlocks) -> Path:
    (lines,) = code_blocks(GUIDE, "ini")
    file = tmp_path / "antennas.ini"
    protocol = '*.numUavs = 1\n*.uavs[*].protocol.class = "python.quiet_protocol:Quiet"\n'
    file.write_text(f"[General]\nsim-time-limit = 1s\n{protocol}{lines}")
    return file


def test_each_excerpt_is_in_a_file_that_is_named_before_it(root: Path) -> None:
    guide = (root / GUIDE).read_text(encoding="utf-8")
    excerpts = list(re.finditer(r"^```cpp\n(.*?)^```", guide, re.MULTILINE | re.DOTALL))
    assert len(excerpts) > 6
    for excerpt in excerpts:
        named = re.findall(r"`((?:cpp|tests)/[\w/.]+\.[ch]pp)`", guide[: excerpt.start()])
        assert any(excerpt[1] in (root / file).read_text(encoding="utf-8") for file in named), excerpt[1]


def test_its_files_are_there(root: Path) -> None:
    paths = re.findall(r"`((?:cpp|python|tests|docs)/[\w./-]+)`", (root / GUIDE).read_text(encoding="utf-8"))
    assert len(paths) > 15
    assert [path for path in paths if not (root / path).exists()] == []


def test_its_ini_selects_the_model(scenario_file: Path) -> None:
    (scenario,) = load_scenarios(scenario_file)
    assert scenario.nodes[0].wlan[0].antenna["typename"].value == "ParabolicAntenna"


def test_a_misspelled_name_gets_the_suggestion(root: Path, scenario_file: Path) -> None:
    scenario_file.write_text(scenario_file.read_text().replace("Parabolic", "Parabollic"))
    with pytest.raises(ConfigError) as error:
        load_scenarios(scenario_file)
    (quoted,) = re.findall(r"``(did you mean .*?) ``", (root / GUIDE).read_text(encoding="utf-8"))
    assert quoted in str(error.value)
