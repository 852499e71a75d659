"""Whatever an .ini file says, `gradysim check` gives findings or errors with their places, in bounded time.

To try more, and others: `GRADYSIM_MUTANTS=5000 GRADYSIM_FIRST_MUTANT=1000000 pytest tests/python/fuzz`.
A failure says how to repeat it. Mutants that found a mistake belong in `tests/corpus/ini`.
"""

import contextlib
import os
import random
import signal
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from types import FrameType

import pytest

from gradysim.cli.check import check_config
from gradysim.scenario.errors import ConfigError, ErrorCollector
from gradysim.scenario.ini import read_ini
from gradysim.scenario.sections import config_names
from python.fuzz.mutants import ROOT, SOURCES, mutant

COUNT = int(os.environ.get("GRADYSIM_MUTANTS", "300"))
FIRST = int(os.environ.get("GRADYSIM_FIRST_MUTANT", "0"))
PARTS = 4
MOST_CPU_S = 20
MOST_S = 600  # of a machine that does other things, too
LONGEST_MESSAGE = 1000
MOST_WITHOUT_LINE = 0.01


class HangError(BaseException):
    """A file took too long."""


@contextlib.contextmanager
def in_bounded_time() -> Iterator[None]:
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


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the folders of .ini files, by links: protocols and included files are found from there."""
    folder = tmp_path_factory.mktemp("mutants")
    for source in SOURCES:
        place = folder / source.parent.relative_to(ROOT)
        place.mkdir(parents=True, exist_ok=True)
        for sibling in source.parent.iterdir():
            if sibling.is_file() and not (place / sibling.name).exists():
                (place / sibling.name).symlink_to(sibling)
    if not (folder / "examples").exists():
        (folder / "examples").symlink_to(ROOT / "examples")
    return folder


def errors_of(file: Path, rng: random.Random) -> list[ConfigError]:
    """Return the errors of one configuration of a file, as `gradysim check` reports them."""
    errors = ErrorCollector()
    with contextlib.suppress(ConfigError), errors.collecting():
        config = rng.choice(config_names(read_ini(file)))
        check_config(file, config, rng.choice(("integrated", "prototype")), (), errors)
    return errors.errors


def check_mutant(seed: int, folder: Path) -> list[ConfigError]:
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


@pytest.mark.parametrize("part", range(PARTS))
def test_each_mutant_is_read_or_refused_with_a_place(folder: Path, part: int) -> None:
    problems: Counter[str] = Counter()
    count = without_line = 0
    with contextlib.redirect_stdout(sys.stderr):
        for seed in range(FIRST + part, FIRST + COUNT, PARTS):
            errors = check_mutant(seed, folder)
            count += len(errors)
            without = [error for error in errors if error.line == 0]
            without_line += len(without)
            problems.update(error.problem for error in without)
    assert without_line <= 1 + MOST_WITHOUT_LINE * count, problems


def test_the_corpus_has_no_errors_itself() -> None:
    file = ROOT / "tests/corpus/ini/grammar.ini"
    errors = ErrorCollector()
    for config in config_names(read_ini(file)):
        check_config(file, config, "integrated", (), errors)
    assert errors.errors == []
