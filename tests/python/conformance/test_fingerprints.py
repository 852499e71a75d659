"""The example configurations have the hashes in tests/fingerprints/fingerprints.csv."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "fingerprints"))

from fingerprint_file import Example, examples, read

EXAMPLES = list(examples())


def name(example: Example) -> str:
    return f"{example.config}-{example.seed}"


def test_each_example_is_in_the_file_and_no_other() -> None:
    assert list(read()) == EXAMPLES, "run `make fingerprints`"


@pytest.mark.parametrize("example", EXAMPLES, ids=name)
def test_what_it_computes_is_what_it_was(example: Example) -> None:
    rule = "tests/fingerprints/update.py says when it is legitimate to run `make fingerprints`"
    assert example.hashes() == read()[example], rule
