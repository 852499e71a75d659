"""gradysim 0.8 of other authors in the same directory."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from gradysim import installation

SOURCES = Path(__file__).parents[2] / "python/gradysim"


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """Return the package as pip installs it."""
    ignored = shutil.ignore_patterns("__pycache__")
    return Path(shutil.copytree(SOURCES, tmp_path / "gradysim", ignore=ignored))


def last_line(package: Path, program: str) -> str:
    """Return the last line that a program prints which sees no other installation."""
    search = f"import sys; sys.path[:0] = [{str(package.parent)!r}]; "
    done = subprocess.run(
        [sys.executable, "-I", "-S", "-c", search + program],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    return done.stdout.rstrip().rpartition("\n")[2]


def sentence(package: Path) -> str:
    return (
        f"ImportError: {package} has files of two packages, gradysim 0.8 and this one; "
        "run `pip uninstall gradysim` until it finds none, then install the one that you want"
    )


def add_file_of_08(package: Path) -> None:
    (package / installation.FILE_OF_08).touch()


def test_an_installation_of_its_own_is_fine(package: Path) -> None:
    assert last_line(package, "import gradysim.protocol.interface; print('fine')") == "fine"


def test_the_import_notices_files_of_08(package: Path) -> None:
    add_file_of_08(package)
    assert last_line(package, "import gradysim.protocol.interface") == sentence(package)


def test_the_command_notices_that_08_was_installed_over_it(package: Path) -> None:
    add_file_of_08(package)
    (package / "__init__.py").write_text("")
    assert last_line(package, "import gradysim.cli.app") == sentence(package)
