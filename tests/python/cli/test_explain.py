"""`gradysim explain`: the value of a parameter and where it comes from."""

from pathlib import Path

import pytest

from gradysim.cli.app import main

CONFIGS = Path(__file__).parents[3] / "configs"
ZIGZAG = str(CONFIGS / "zigzag.ini")
POWER = "uavs[0].wlan[0].radio.transmitter.power"


def rows(output: str) -> dict[str, str]:
    """Return {label: text}; the first line has the label ""."""
    first, *others = output.splitlines()
    return {"": first} | {line[:12].strip(): line[12:] for line in others}


def test_prints_the_value_and_the_line_that_sets_it(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", ZIGZAG, POWER, "-c", "ZigZag5", "--set", f"*.{POWER}=2mW"]) == 0
    shown = rows(capsys.readouterr().out)
    assert shown[""] == f"{POWER} = 2mW"
    assert shown["set by"] == f"--set *.{POWER}=2mW"
    assert shown["hides"].endswith("**.wlan[*].radio.transmitter.power = 0.95mW")
    assert shown["default"] == "20mW"


def test_explains_the_run_that_is_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    values = []
    for run in ("0", "1"):
        arguments = ["-c", "ZigZag5", "--run", run, "--set", "*.uavs[*].mobility.speed=${1, 2}mps"]
        assert main(["explain", ZIGZAG, "uavs[0].mobility.speed", *arguments]) == 0
        values.append(rows(capsys.readouterr().out)[""])
    assert values == ["uavs[0].mobility.speed = 1mps", "uavs[0].mobility.speed = 2mps"]


def test_says_that_nothing_reads_it(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", ZIGZAG, "radioMedium.pathLoss.sigma", "-c", "ZigZag5"]) == 0
    assert "LogNormalShadowing" in rows(capsys.readouterr().out)["read by"]


@pytest.mark.parametrize(
    "arguments",
    [
        (ZIGZAG, "uavs[0].mobility.sped", "-c", "ZigZag5"),
        (ZIGZAG, "uavs[0].mobility.speed", "-c", "ZigZag6"),
        (ZIGZAG, "uavs[0].mobility.speed", "-c", "ZigZag5", "--run", "1000000"),
        (ZIGZAG, "uavs[0].mobility.speed"),
        ("missing.ini", "uavs[0].mobility.speed"),
        (".", "uavs[0].mobility.speed"),
        ("/dev/zero", "uavs[0].mobility.speed"),
        (ZIGZAG, "\0"),
        (ZIGZAG,),
    ],
)
def test_a_mistake_is_an_error_without_output(
    arguments: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["explain", *arguments]) == 2
    output = capsys.readouterr()
    assert output.out == ""
    assert output.err
