"""A capture of an 802.15.4 node: scapy and tshark understand its frames."""

import shutil
import subprocess
from collections import Counter
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")
pytest.importorskip("scapy")

from scapy.layers.dot15d4 import Dot15d4FCS
from scapy.utils import PcapReader

from gradysim.integrated.run import IntegratedRun
from gradysim.results.result import RunResult
from gradysim.scenario import load_scenarios

INI = Path(__file__).parents[3] / "configs" / "sensor_field.ini"
DATA, ACK = 1, 2
LINK_TYPE = 195


@pytest.fixture(scope="module")
def field(tmp_path_factory: pytest.TempPathFactory) -> tuple[RunResult, Path]:
    """Return twenty seconds of the sensor field, and the file of its ground station."""
    file = tmp_path_factory.mktemp("captures") / "groundStation.pcap"
    (scenario,) = load_scenarios(INI, "Spread", overrides=["sim-time-limit = 20s"])
    run = IntegratedRun(scenario, {0: file})
    run.execute()
    return run.result(), file


def test_the_file_has_the_link_type_of_its_frames(field: tuple[RunResult, Path]) -> None:
    assert int.from_bytes(field[1].read_bytes()[20:24], "little") == LINK_TYPE


def test_scapy_finds_what_the_ledger_counts(field: tuple[RunResult, Path]) -> None:
    result, file = field
    with PcapReader(str(file)) as reader:
        frames = [Dot15d4FCS(bytes(packet)) for packet in reader]
    kinds = Counter(frame.fcf_frametype for frame in frames)
    delivered = result.outcomes["frames"]["unicast"]["delivered"]
    assert delivered > 0
    assert kinds == {DATA: delivered, ACK: delivered}
    assert {frame.fcf_ackreq for frame in frames if frame.fcf_frametype == DATA} == {1}


@pytest.mark.skipif(shutil.which("tshark") is None, reason="tshark is not installed")
def test_tshark_finds_nothing_wrong(field: tuple[RunResult, Path]) -> None:
    command = ["tshark", "-r", str(field[1]), "-Y", "_ws.malformed || _ws.expert.severity >= 4194304"]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == ""
