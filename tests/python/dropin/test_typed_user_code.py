"""A user's protocols, handler and script, `scout.py`, satisfy `mypy --strict` against the package."""

import shutil
import subprocess
import sys
from pathlib import Path

SCOUT = Path(__file__).with_name("scout.py")


def test_a_users_code_type_checks_strictly(tmp_path: Path) -> None:
    shutil.copy(SCOUT, tmp_path)
    package = Path(__file__).parents[3] / "python"
    check = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--config-file=", "scout.py"],
        cwd=tmp_path,
        env={"MYPYPATH": str(package), "PATH": ""},
        capture_output=True,
        text=True,
        check=False,
    )
    assert check.returncode == 0, check.stdout + check.stderr
