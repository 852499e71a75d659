from pathlib import Path

from gradysim.scenario.errors.source import Source


def test_a_line_of_a_file() -> None:
    assert str(Source(Path("configs/a.ini"), 7, "repeat", "0")) == "configs/a.ini:7"


def test_an_override() -> None:
    source = Source(Path("a.ini"), 0, "repeat", "0", "--set")
    assert source.is_override
    assert str(source) == "--set repeat=0"


def test_a_long_value_of_an_override_is_cut() -> None:
    assert str(Source(Path("a.ini"), 0, "*.x.points", "1 " * 500, "--set")) == (
        f"--set *.x.points={'1 ' * 50}…"
    )


def test_a_whole_file() -> None:
    source = Source(Path("a.ini"), 0)
    assert not source.is_override
    assert str(source) == "a.ini"
