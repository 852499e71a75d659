"""`gradysim import`: translates an omnetpp.ini of OMNeT++, and lists what was done with each of its lines."""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from gradysim.cli.errors import MISTAKE, OK, report_error
from gradysim.cli.options import FileArgument
from gradysim.encapsulator.run_context import gc_paused
from gradysim.omnetpp_import import Outcome, Translation, translate
from gradysim.scenario.errors import ConfigError

OutputOption = Annotated[
    Path,
    Parameter(
        name="--output", alias="-o", help="The directory of the translated file, which has the same name."
    ),
]


def import_file(file: FileArgument, /, *, output: OutputOption = Path("imported")) -> int:
    """Carry out `gradysim import`, and return the exit code."""
    target = output / file.name
    if target.exists():
        print(f"{target} is there already; expected another directory: -o DIR", file=sys.stderr)
        return MISTAKE
    try:
        with gc_paused():  # nothing of what is read is garbage
            translation = translate(file, output)
        output.mkdir(parents=True, exist_ok=True)
        target.write_text(translation.text, encoding="utf-8")
    except (ConfigError, OSError) as error:
        return report_error(error)
    for line in _rows(translation, file):
        print(line)
    counts = ", ".join(f"{count} {action.value}" for action, count in translation.counts().items())
    print(f"{target}: {counts}")
    return OK


def _rows(translation: Translation, file: Path) -> Iterator[str]:
    for outcome in translation.outcomes:
        where = ""
        if outcome.entry is not None:
            source = outcome.entry.source
            where = str(source.line) if source.file == file else f"{source.file.name}:{source.line}"
        yield f"{where:>5}  {outcome.action.value:12}  {_text(outcome)}".rstrip()


def _text(outcome: Outcome) -> str:
    entry = outcome.entry
    before = "" if entry is None else f"{entry.key} = {entry.source.value}"
    line = " ".join(outcome.text.split("\n"))
    changed = " -> ".join(text for text in dict.fromkeys((before, line)) if text)
    return f"{changed}  ({outcome.note})" if outcome.note else changed
