"""`gradysim new`: makes a directory with which to begin."""

import shlex
import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import resources
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from gradysim.cli import examples
from gradysim.cli.errors import MISTAKE, OK, report_error
from gradysim.cli.options import Flag
from gradysim.results.durable import naming
from gradysim.scenario.errors import did_you_mean

_FILES = {
    "protocols.py": "protocols.py",
    "scenario.ini": "NAME.ini",
    "test_protocols.py": "test_protocols.py",
}
"""{template: file}."""


NameArgument = Annotated[
    str | None,
    Parameter(
        name="NAME", help="Name of the directory and its .ini file; with --example: name of the example."
    ),
]
ExampleOption = Annotated[
    Flag, Parameter(help="Copy the example NAME instead. Without a NAME, list the examples.")
]


def make_project(name: NameArgument = None, /, *, example: ExampleOption = False) -> int:
    """Carry out `gradysim new`, and return the exit code."""
    if example:
        return _list_examples() if name is None else _copy_example(name)
    if name is None:
        print("expected a NAME, such as `gradysim new swarm`", file=sys.stderr)
        return MISTAKE
    folder = Path(name)
    try:
        with _making(folder):
            for template, file in _FILES.items():
                source = resources.files("gradysim.cli").joinpath("templates", template)
                (folder / file.replace("NAME", folder.name)).write_text(
                    source.read_text(encoding="utf-8").replace("NAME", folder.name), encoding="utf-8"
                )
    except OSError as error:
        return report_error(error)
    scenarios = shlex.quote(str(folder / f"{folder.name}.ini"))
    print(f"gradysim view {scenarios}                # watch: all reports collide")
    print(f"gradysim view {scenarios} -c Jittered    # with a random wait they arrive")
    print(f"gradysim run {scenarios} -c Study --jobs 2 --result-dir {shlex.quote(str(folder / 'results'))}")
    print(f"python -m pytest {shlex.quote(str(folder))}")
    return OK


@contextmanager
def _making(directory: Path) -> Iterator[None]:
    """Make a directory, and remove it if its files cannot be written, so that the command can be repeated."""
    directory.mkdir(parents=True)
    try:
        with naming(directory):
            yield
    except BaseException:
        shutil.rmtree(directory, ignore_errors=True)
        raise


def _list_examples() -> int:
    width = max(map(len, examples.NAMES))
    for name in examples.NAMES:
        print(f"{name:{width}}  {examples.subject(name)}")
    return OK


def _copy_example(name: str) -> int:
    if name not in examples.NAMES:
        names = ", ".join(examples.NAMES)
        suggestion = did_you_mean(name, examples.NAMES)
        print(f"`{name}` is not an example; expected one of {names}{suggestion}", file=sys.stderr)
        return MISTAKE
    directory = Path(name)
    try:
        with _making(directory):
            examples.copy_files(name, directory)
    except OSError as error:
        return report_error(error)
    print(f"cd {name}", *examples.commands(name), sep="\n")
    return OK
