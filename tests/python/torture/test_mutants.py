"""For any .ini file, `gradysim check` gives findings or errors with their places, in bounded time.

`make torture` tries further files. A failure says how to repeat it. Mutants that found a bug belong in
`tests/corpus/ini`.
"""

import contextlib
import os
import sys
from collections import Counter
from pathlib import Path

import pytest

from gradysim.cli.check import check_config
from gradysim.scenario.errors import ErrorCollector
from gradysim.scenario.parse.ini import read_ini
from gradysim.scenario.parse.sections import config_names
from python.thorough import some
from python.torture.mutant_files import ROOT
from python.torture.mutants import check_mutant, link_sources

COUNT = int(os.environ.get("GRADYSIM_MUTANTS", "300"))
FIRST = int(os.environ.get("GRADYSIM_FIRST_MUTANT", "0"))
PARTS = 8
MOST_WITHOUT_LINE = 0.01


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("mutants")
    link_sources(folder)
    return folder


@pytest.mark.parametrize("part", some(range(PARTS)))
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
