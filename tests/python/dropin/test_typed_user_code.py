"""A user's protocols, handler and script, `scout.py`, satisfy `mypy --strict` against the package."""

import shutil
from collections.abc import Callable
from pathlib import Path

SCOUT = Path(__file__).with_name("scout.py")


def test_a_users_code_type_checks_strictly(tmp_path: Path, type_errors: Callable[[Path], str]) -> None:
    shutil.copy(SCOUT, tmp_path)
    assert type_errors(tmp_path / "scout.py") == ""
