"""The output in docs/how-to/compute-means.md is the output of the command and of the scripts."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.results import read_means

GUIDE = "docs/how-to/compute-means.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.fixture
def study(code_blocks: CodeBlocks, shell: Callable[[str, Path], str], tmp_path: Path) -> Path:
    """Return a directory with the results of its study."""
    shell("\n".join(code_blocks(GUIDE, "sh")[0].splitlines()[:2]), tmp_path)
    return tmp_path


@pytest.mark.verify
def test_the_means_are_those_that_are_shown(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], shows: Callable[..., None], study: Path
) -> None:
    command = code_blocks(GUIDE, "sh")[0].splitlines()[-1]
    shows(GUIDE, shell(command, study))


@pytest.mark.verify
def test_its_other_commands_select_quantities(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], study: Path
) -> None:
    some, own, csv = code_blocks(GUIDE, "sh")[1].splitlines()
    shown = [
        line for line in code_blocks(GUIDE, "text")[0].splitlines() if " heard " in line or "delay" in line
    ]
    assert [line.rstrip() for line in shell(some, study).splitlines()[3:]] == shown
    assert len(shell(own, study).splitlines()) == 3 + 4 * 2
    shell(csv, study)
    assert len((study / "means.csv").read_text().splitlines()) == 1 + 4 * 4


@pytest.mark.verify
def test_the_interval_of_an_event_is_shown_by_its_ends(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], shows: Callable[..., None], swarm: Path
) -> None:
    (swarm / "alarm.ini").write_text(code_blocks(GUIDE, "ini")[0])
    shows(GUIDE, shell(code_blocks(GUIDE, "sh")[2], swarm), 1)


def test_its_script_computes_the_means_of_the_command(code_blocks: CodeBlocks, study: Path) -> None:
    names: dict[str, Any] = {}
    exec("\n".join(code_blocks(GUIDE, "python")), names)
    results = str(study / "results")
    heard = {mean.iterations["vehicles"]: mean for mean in read_means(results, "station heard")}
    arrived = names["arrived"](results)
    assert {vehicles: (share.mean, share.low, share.high) for vehicles, share in arrived.items()} == {
        vehicles: pytest.approx((mean.mean / sent, mean.low / sent, mean.high / sent))
        for vehicles, mean in heard.items()
        for sent in [59 * int(str(vehicles))]  # 59 reports of each vehicle
    }
    delays = [mean.mean for mean in read_means(results) if "delay" in mean.quantity]
    assert list(names["mean_delays_s"](results).values()) == delays
