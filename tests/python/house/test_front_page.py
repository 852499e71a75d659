"""The commands of docs/index.md, the front page of the site, do what it says."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

from python.viewing import watched


def test_its_commands_show_reports_that_collide(
    code_blocks: Callable[[str, str], list[str]], shell: Callable[..., str], tmp_path: Path
) -> None:
    (block,) = code_blocks("docs/index.md", "sh")
    install, new, view = (line.partition("#")[0].strip() for line in block.splitlines())
    assert install == "pip install ."
    shell(new, tmp_path)
    assert watched(view, tmp_path)[0]["complete"]
    for config, arrives in (("General", False), ("Jittered", True)):
        result = json.loads(shell(f"gradysim run swarm/swarm.ini -c {config} --json --quiet", tmp_path))
        heard = {node["name"]: node["tracked_variables"] for node in result["nodes"]}["station"]["heard"]
        sent = sum(node["tracked_variables"].get("reports", 0) for node in result["nodes"])
        assert (heard == sent) == arrives
        assert arrives or heard == 0
