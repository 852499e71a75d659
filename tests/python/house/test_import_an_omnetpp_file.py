"""What docs/how-to/import-an-omnetpp-file.md shows is what happens."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.cli.app import main
from python.quiet_protocol import QUIET

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/import-an-omnetpp-file.md"


def test_its_commands_do_what_it_says(
    code_blocks: Callable[[str, str], list[str]],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    shows: Callable[..., None],
) -> None:
    monkeypatch.chdir(tmp_path)
    _, before = code_blocks(GUIDE, "text")
    command, further = code_blocks(GUIDE, "sh")
    Path("omnetpp.ini").write_text(before)
    Path("fleet.py").write_text(
        QUIET + "".join(f"class {name}(Quiet): ...\n" for name in ("Sensor", "Station"))
    )
    assert main(command.split()[1:]) == 0
    shows(GUIDE, capsys.readouterr().out)
    (line,) = code_blocks(GUIDE, "ini")
    file = Path("imported/omnetpp.ini")
    (before,) = (row for row in file.read_text().splitlines() if "# to write: " in row)
    assert before.split()[:3] == [*line.split()[:2], "default"]
    file.write_text(file.read_text().replace(before, line))
    for line in further.splitlines():
        assert main(line.split()[1:]) == 0
    assert "0 errors and 0 warnings" in capsys.readouterr().out
