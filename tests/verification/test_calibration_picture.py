"""Picture of `gradysim calibrate`. Only with --verify: the other tests do not need matplotlib."""

from pathlib import Path

import pytest

from gradysim.cli.app import main

_ZIGZAG = Path(__file__).parents[2] / "configs" / "zigzag.ini"


@pytest.mark.parametrize("ending", ["svg", "png", "pdf"])
def test_a_picture_is_drawn(tmp_path: Path, ending: str) -> None:
    file = tmp_path / f"curve.{ending}"
    arguments = ["calibrate", str(_ZIGZAG), "-c", "ZigZag5", "--range", "50m", "--picture", str(file)]
    assert main(arguments) == 0
    assert file.stat().st_size > 1000
    if ending == "svg":
        text = file.read_text(encoding="utf-8")
        assert "share of frames received" in text
        assert "uavs[0] to another one like it, " in text


def test_an_ending_that_names_no_format_is_a_mistake(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ["calibrate", str(_ZIGZAG), "-c", "ZigZag5", "--range", "50m"]
    assert main([*arguments, "--picture", str(tmp_path / "curve.xyz")]) == 2
    assert "xyz" in capsys.readouterr().err
