"""Mutants of .ini files: their errors have places, and none makes the command hang."""

import contextlib
import random
import signal
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from types import FrameType

from gradysim.cli.check import check_config
from gradysim.scenario.errors import ConfigError, ErrorCollector
from gradysim.scenario.parse.ini import read_ini
from gradysim.scenario.parse.sections import config_names
from python.torture.mutant_files import ROOT, SOURCES, mutant

MOST_CPU_S = 20
MOST_S = 600  # on a busy machine
LONGEST_MESSAGE = 1000
_AT_ONCE = 50


class HangError(BaseException):
    """A file took too long."""


@contextlib.contextmanager
def in_bounded_time() -> Iterator[None]:
    """Raise HangError in a block that does not end."""

    def stop(_number: int, _frame: FrameType | None) -> None:
        raise HangError

    before = {number: signal.signal(number, stop) for number in (signal.SIGPROF, signal.SIGALRM)}
    signal.setitimer(signal.ITIMER_PROF, MOST_CPU_S)
    signal.alarm(MOST_S)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.alarm(0)
        for number, handler in before.items():
            signal.signal(number, handler)


def link_sources(folder: Path) -> None:
    """Link the directories of .ini files, which contain protocols and included files."""
    for source in SOURCES:
        place = folder / source.parent.relative_to(ROOT)
        place.mkdir(parents=True, exist_ok=True)
        for sibling in source.parent.iterdir():
            if sibling.is_file() and not (place / sibling.name).exists():
                (place / sibling.name).symlink_to(sibling)
    if not (folder / "examples").exists():
        (folder / "examples").symlink_to(ROOT / "examples")


def errors_of(file: Path, rng: random.Random) -> list[ConfigError]:
    """Return the errors of one configuration of a file, as `gradysim check` reports them."""
    errors = ErrorCollector()
    with contextlib.suppress(ConfigError), errors.collecting():
        config = rng.choice(config_names(read_ini(file)))
        check_config(file, config, rng.choice(("integrated", "prototype")), (), errors)
    return errors.errors


def check_mutant(seed: int, folder: Path) -> list[ConfigError]:
    """Return the errors of a mutant, found in bounded time. Each has a place and is short."""
    source, content = mutant(seed)
    file = folder / source.parent.relative_to(ROOT) / "test.ini"
    file.write_bytes(content)
    try:
        with in_bounded_time():
            errors = errors_of(file, random.Random(seed))
        for error in errors:
            assert error.file is not None, error
            assert len(str(error)) <= LONGEST_MESSAGE, error
    except BaseException as failure:
        kept = Path(tempfile.gettempdir()) / f"mutant-{seed}.ini"
        kept.write_bytes(content)
        failure.add_note(f"GRADYSIM_MUTANTS=1 GRADYSIM_FIRST_MUTANT={seed}: {source}, changed: {kept}")
        raise
    return errors


def once(rng: random.Random, folder: Path) -> int:
    """Check some mutants; return how many."""
    link_sources(folder)
    with contextlib.redirect_stdout(sys.stderr):
        for _ in range(_AT_ONCE):
            check_mutant(rng.randrange(2**32), folder)
    return _AT_ONCE
