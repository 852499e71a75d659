"""The script that runs the steps, and its output in docs/how-to/repeat-the-paper.md."""

import re
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")

import steps
from steps import STEPS, row

GUIDE = Path(__file__).parents[4] / "docs/how-to/repeat-the-paper.md"


def shown() -> list[list[str]]:
    """Return the rows of its table in the guide."""
    block = re.findall(r"^```text\n(ZigZag5, run 0\n.*?)^```", GUIDE.read_text(), re.MULTILINE | re.DOTALL)[0]
    return [re.split(r" {2,}", line.strip()) for line in block.splitlines()[4:]]


def test_the_guide_shows_all_steps_in_both_modes() -> None:
    assert [cells[:2] for cells in shown()] == [
        [step.text, mode] for step in STEPS for mode in ("prototype", "integrated")
    ]


@pytest.mark.verify
@pytest.mark.parametrize("number", range(4))
def test_a_step_in_integrated_mode_is_as_shown(number: int) -> None:
    assert row("ZigZag5", STEPS[number], "integrated") == shown()[2 * number + 1]


@pytest.mark.verify
@pytest.mark.parametrize("number", [1, 2, 3])
def test_a_step_in_prototype_mode_is_as_shown(number: int) -> None:
    assert row("ZigZag5", STEPS[number], "prototype") == shown()[2 * number]


def test_in_the_first_step_uavs_are_stuck_from_the_start() -> None:
    """Two hours take long. Since nothing changes, ten minutes have a twelfth of the exchanges."""
    _, _, readings, exchanges, nearest = row("ZigZag5", STEPS[0], "prototype", "sim-time-limit = 10min")
    told = shown()[0]
    assert (readings, nearest) == (told[2], told[4])
    assert 12 * int(exchanges.replace(",", "")) == int(told[3].replace(",", ""))


def test_the_table_has_a_row_for_each_step_and_mode(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(steps, "row", lambda size, step, mode: [step.text, mode, "1", "2", "3 m"])
    steps.main(["ZigZag15"])
    lines = [re.split(r" {2,}", line.strip()) for line in capsys.readouterr().out.splitlines()]
    assert ["ZigZag15, run 0"] in lines
    assert [line[:2] for line in lines if line[-1] == "3 m"] == [cells[:2] for cells in shown()]
