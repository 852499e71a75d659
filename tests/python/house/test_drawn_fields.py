"""What tests of the engine draw at random: a field that none of them draws is tried with its default only."""

import re
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.integrated.engine_defaults import engine_defaults
from gradysim.scenario.keys.path_loss import PATH_LOSS_KEYS

SUPPORT = Path("tests/cpp/support")

NOT_DRAWN = {
    "typename",  # drawn by its name in C++, type_name
    "propagation",  # there is one
    *("error_model", "ber_table_file"),  # the other one reads a file
    "ack_end_s",  # follows from others
}


def missing(root: Path, file: str, fields: set[str]) -> set[str]:
    words = set(re.findall(r"\w+", (root / SUPPORT / file).read_text(encoding="utf-8")))
    return fields - words


@pytest.mark.parametrize("struct", ["medium", "radio", "mac", "csma"])
def test_the_fuzzer_draws_each_field(root: Path, struct: str) -> None:
    config = engine_defaults()[struct][""]
    fields = {
        name for name in dir(config) if not name.startswith("_") and not callable(getattr(config, name))
    }
    assert missing(root, "fuzzed_config.hpp", fields - NOT_DRAWN) == set()


def test_bounds_of_path_losses_are_tried_with_other_values_than_the_defaults(root: Path) -> None:
    other = {"path_loss", "coherence_time_s"}  # which one it is, and how long its fading lasts
    fields = {key.field for key in PATH_LOSS_KEYS} - other
    assert missing(root, "drawn_path_loss.hpp", fields) == set()
