"""Fields that tests of the engine draw at random. Other fields are tested with their default only."""

import re
from pathlib import Path

from gradysim.scenario.keys import PATH_LOSS_KEYS

SUPPORT = Path("tests/cpp/support")


def test_bounds_of_path_losses_are_tried_with_other_values_than_the_defaults(root: Path) -> None:
    other = {"path_loss", "coherence_time_s"}  # the model, and the coherence time of its fading
    fields = {key.field for key in PATH_LOSS_KEYS} - other | {"shadowing_standard_deviation_db"}
    words = re.findall(r"\w+", (root / SUPPORT / "drawn_path_loss.hpp").read_text(encoding="utf-8"))
    assert fields - set(words) == set()
