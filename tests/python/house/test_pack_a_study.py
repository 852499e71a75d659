"""The outputs in docs/how-to/pack-a-study.md are those of the commands."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.results import read_means

GUIDE = "docs/how-to/pack-a-study.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.mark.verify
def test_its_commands_print_what_is_shown(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], shows: Callable[..., None], tmp_path: Path
) -> None:
    study, more, several, back, verify = code_blocks(GUIDE, "sh")
    new, *commands = study.splitlines()
    shell(new, tmp_path)
    shows(GUIDE, shell("\n".join(commands), tmp_path), 0)

    names: dict[str, Any] = {}
    exec("\n".join(code_blocks(GUIDE, "python")), names)
    heard = names["heard"](str(tmp_path / "results" / "packs" / "runs.sca"))
    means = read_means(tmp_path / "results", "station heard")
    assert sum(heard) == pytest.approx(sum(mean.runs * (mean.mean or 0) for mean in means))

    shows(GUIDE, shell(more, tmp_path), 1)
    packed, *tables, joined = shell(several, tmp_path).splitlines()
    assert packed == "packed 40 new runs into share1.sca"
    assert tables[: len(tables) // 2] == tables[len(tables) // 2 :]
    assert joined == "packed 40 new runs into all/packs/runs.sca, and removed packed JSON files"
    shows(GUIDE, shell(back, tmp_path), 2)
    assert len(list((tmp_path / "results").glob("Study-*.json"))) == 40
    shows(GUIDE, shell(verify, tmp_path), 3)

    run = "gradysim run swarm/swarm.ini -c Study -r 3 --result-dir results --quiet --pcap station"
    shell(run, tmp_path)
    capture = tmp_path / "results" / "Study-#3-station.pcap"
    capture.write_bytes(capture.read_bytes()[:-1])
    shows(GUIDE, shell(f"{verify.strip()} || true", tmp_path), 4)
