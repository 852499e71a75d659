"""An omnetpp.ini of GrADyS' C++ project, in small, and its translation."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.omnetpp_import import Outcome, Translation, translate

Translated = Callable[..., Translation]


@pytest.fixture
def translated(tmp_path: Path) -> Translated:
    """`translated(text, ned="")`: the translation of a file, next to a NED file if there is one."""

    def translation(text: str, ned: str = "") -> Translation:
        (tmp_path / "omnetpp.ini").write_text(text)
        if ned:
            (tmp_path / "Network.ned").write_text(ned)
        return translate(tmp_path / "omnetpp.ini", tmp_path / "imported")

    return translation


@pytest.fixture
def outcome(translated: Translated) -> Callable[..., Outcome]:
    """`outcome(line, *others)`: what becomes of the first of these lines of GradysNetwork."""

    def first(line: str, *others: str) -> Outcome:
        lines = "\n".join([line, *others, "network = GradysNetwork", "sim-time-limit = 1s"])
        return translated(f"[General]\n{lines}\n").outcomes[0]

    return first
