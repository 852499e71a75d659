"""`gradysim new`: makes a folder with which to begin."""

import shlex
from importlib import resources
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from gradysim.cli.errors import OK, say_mistake

_FILES = {
    "protocols.py": "protocols.py",
    "scenario.ini": "NAME.ini",
    "test_protocols.py": "test_protocols.py",
}
"""{template: file}."""


def make_project(name: Annotated[str, Parameter(help="Of the folder, and of its .ini file.")], /) -> int:
    """Make a folder with a protocol, scenarios and a test to begin with."""
    folder = Path(name)
    try:
        folder.mkdir(parents=True)
        for template, file in _FILES.items():
            text = resources.files("gradysim.cli").joinpath("templates", template).read_text(encoding="utf-8")
            (folder / file.replace("NAME", folder.name)).write_text(
                text.replace("NAME", folder.name), encoding="utf-8"
            )
    except OSError as error:
        return say_mistake(error)
    scenarios = shlex.quote(str(folder / f"{folder.name}.ini"))
    print(f"gradysim view {scenarios}                # watch: all reports collide")
    print(f"gradysim view {scenarios} -c Jittered    # with a random wait they arrive")
    print(f"gradysim run {scenarios} -c Study --jobs 2 --result-dir {shlex.quote(str(folder / 'results'))}")
    print(f"python -m pytest {shlex.quote(str(folder))}")
    return OK
