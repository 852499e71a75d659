"""The output in docs/how-to/watch-a-run.md is correct."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.cli.app import main
from gradysim.replay.tables import NOT_LOST
from python.viewing import visited, watched


@pytest.fixture
def text(root: Path) -> str:
    return (root / "docs/how-to/watch-a-run.md").read_text()


@pytest.fixture
def folder(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a directory with the example of the guides. It is the working directory."""
    example = (root / "docs/reference/example.md").read_text()
    for language, name in [("python", "hello.py"), ("ini", "hello.ini")]:
        (tmp_path / name).write_text(
            re.findall(rf"^```{language}\n(.*?)^```", example, re.MULTILINE | re.DOTALL)[0]
        )
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.verify
def test_its_commands_of_sh(text: str, folder: Path, shell: Callable[..., str]) -> None:
    lines = "".join(re.findall(r"^```sh\n(.*?)^```", text, re.MULTILINE | re.DOTALL)).splitlines()
    for line in lines:
        command = line.partition(" # ")[0].strip()
        if command.startswith("gradysim view hello.ini"):
            assert watched(command, folder)[0]["complete"]
        elif (
            command.startswith("gradysim view") and len(replays := list(folder.glob(command.split()[-1]))) > 1
        ):
            assert visited(" ".join(["gradysim view", *map(str, replays)]), folder) == 0
        else:
            shell(command.replace("gradysim view", "gradysim view --no-browser"), folder)


def test_its_python_prints_losses(
    text: str,
    folder: Path,
    imported: Callable[[Path], Any],
    capsys: pytest.CaptureFixture[str],
) -> None:
    pytest.importorskip("gradysim._netsim")
    (program,) = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    (folder / "losses.py").write_text(program)
    assert main(["run", "hello.ini", "--replay", "all", "--quiet"]) == 0
    capsys.readouterr()
    imported(folder / "losses.py").print_losses("results/General-#0.integrated.html")
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "{'receiver_transmitting': 708}"
    assert "receiver_transmitting" not in NOT_LOST
    assert len(lines) == 2 + 708
