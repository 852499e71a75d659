"""`gradysim import`: the list, the file, and what is refused."""

from pathlib import Path

import pytest

from gradysim.cli.app import main

INI = """[General]
network = GradysNetwork
repeat = 2
*.numUAVs = 1
*.quads[*].numApps = 1
**.wlan[*].mac.typename = "XMac"
include more.ini
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    (tmp_path / "omnetpp.ini").write_text(INI)
    (tmp_path / "more.ini").write_text('*.quads[*].protocol.typename = "OwnProtocol"\n')
    return tmp_path / "omnetpp.ini"


def test_the_list(file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", str(file), "-o", str(tmp_path / "here")]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[:6] == [
        "    2  kept          network = GradysNetwork",
        "    3  kept          repeat = 2",
        "    4  renamed       *.numUAVs = 1 -> *.numQuads = 1",
        "    5  left out      *.quads[*].numApps = 1  (the protocol of a node sends its messages)",
        '    6  not modelled  **.wlan[*].mac.typename = "XMac"'
        "  (the MAC is DCF of 802.11, or CSMA/CA of 802.15.4)",
        'more.ini:1  to write      *.quads[*].protocol.typename = "OwnProtocol" -> '
        '*.quads[*].protocol.class = "FILE.py:CLASS"  (in Python, what OwnProtocol does)',
    ]
    assert lines[6] == (
        '       added         *.radioMedium.typename = "Ieee802154NarrowbandScalarRadioMedium"'
        "  (default of GradysNetwork)"
    )
    counts = "2 kept, 1 renamed, 8 added, 1 left out, 1 not modelled, 1 to write"
    assert lines[-1] == f"{tmp_path / 'here' / 'omnetpp.ini'}: {counts}"


def test_the_file(file: Path, tmp_path: Path) -> None:
    assert main(["import", str(file), "-o", str(tmp_path / "here")]) == 0
    text = (tmp_path / "here" / "omnetpp.ini").read_text()
    assert text.startswith("# From omnetpp.ini, ")
    assert ': **.wlan[*].mac.typename = "XMac"  (' in text
    assert "\n*.quads[*].protocol.class = default  # " in text


def test_a_file_that_is_there_is_not_overwritten(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", str(file), "-o", str(file.parent)]) == 2
    assert f"{file}" in capsys.readouterr().err
    assert file.read_text() == INI


def test_a_file_that_is_not_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", str(tmp_path / "omnet.ini"), "-o", str(tmp_path / "here")]) == 2
    assert "omnet.ini" in capsys.readouterr().err
    assert not (tmp_path / "here").exists()
