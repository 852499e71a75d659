"""The functions of docs/how-to/step-through-a-run.md in python return what the page shows."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.cli.app import main

pytest.importorskip("gradysim._netsim")

PAGE = "docs/how-to/step-through-a-run.md"


def test_the_station_hears_reports_at_these_times(
    code_blocks: Callable[[str, str], list[str]],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    shows: Callable[..., None],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", "swarm"]) == 0
    names: dict[str, Callable[[str, int], float]] = {}
    exec("\n".join(code_blocks(PAGE, "python")), names)
    capsys.readouterr()
    print(names["until_heard"]("swarm/swarm.ini", 60))
    shows(PAGE, capsys.readouterr().out)
