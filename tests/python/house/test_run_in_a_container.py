"""The commands of docs/how-to/run-in-a-container.md name what there is."""

import re
from collections.abc import Callable
from pathlib import Path

from gradysim.scenario import load_scenarios

PAGE = "docs/how-to/run-in-a-container.md"


def test_its_sh_snippet_names_files_and_a_configuration(
    root: Path, code_blocks: Callable[[str, str], list[str]]
) -> None:
    (commands,) = code_blocks(PAGE, "sh")
    for name in re.findall(r"\b(?:docker|configs)/\S+", commands):
        assert (root / name).exists()
    configurations = re.findall(r"gradysim (?:run|view) (\S+) -c (\S+)", commands)
    assert len(configurations) == 2
    for file, config in configurations:
        load_scenarios(root / file, config)
