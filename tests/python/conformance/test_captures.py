"""A minute of ZigZag5 captured at every node: the frames in scapy and tshark are those in the results."""

import json
import os
import shutil
import subprocess
import sys
from collections import Counter
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")
pytest.importorskip("scapy")

from scapy.layers.dot11 import Dot11FCS, RadioTap
from scapy.layers.inet import IP, UDP
from scapy.utils import PcapReader

NODES = ["uavs[0]", "uavs[1]", *(f"sensors[{i}]" for i in range(5)), "groundStation"]
LONGEST_PROPAGATION_S = Decimal("0.000001")  # 300 m, beyond the range of all nodes

needs_tshark = pytest.mark.skipif(shutil.which("tshark") is None, reason="tshark is not installed")


@dataclass(frozen=True)
class Seen:
    time_s: Decimal
    packet: Any
    frame: bytes

    @property
    def sent(self) -> bool:
        return self.packet.dBm_AntSignal is None

    @property
    def bad(self) -> bool:
        return bool(self.packet.Flags.badFCS)

    @property
    def kind(self) -> str:
        dot11 = self.packet[Dot11FCS]
        if dot11.type == 1:
            return {11: "rts", 12: "cts", 13: "ack"}[dot11.subtype]
        return "broadcast" if dot11.addr1 == "ff:ff:ff:ff:ff:ff" else "unicast"


@dataclass(frozen=True)
class Minute:
    frames: dict[str, dict[str, int]]
    """Outcomes: {kind: {outcome: receptions}}."""
    files: dict[str, Path]
    seen: dict[str, list[Seen]]

    def copies(self, kind: str, *outcomes: str) -> int:
        """Return the receptions of a kind with these outcomes (all, if none), at addressees and others."""
        books = (self.frames[kind], self.frames.get(f"{kind} overheard", {}))
        return sum(
            count for book in books for outcome, count in book.items() if not outcomes or outcome in outcomes
        )

    def count(self, kind: str, *, sent: bool, bad: bool = False) -> int:
        """Return the same count from the files."""
        return sum(
            (one.kind, one.sent, one.bad) == (kind, sent, bad) for all_ in self.seen.values() for one in all_
        )


@pytest.fixture(scope="module")
def minute(tmp_path_factory: pytest.TempPathFactory) -> Minute:
    folder = tmp_path_factory.mktemp("captures")
    root = Path(__file__).parents[3]
    done = subprocess.run(
        [
            *(sys.executable, "-m", "gradysim", "run", str(root / "configs/zigzag.ini"), "-c", "ZigZag5"),
            *("--set", "sim-time-limit = 60s", "--json", "--result-dir", str(folder)),
            *("--set", "**.wlan[*].mac.dcf.rtsPolicy.rtsThreshold = 120B"),
            # High enough that distant frames fail.
            *("--set", "**.wlan[*].radio.receiver.snirThreshold = 15dB", "--pcap", "all"),
        ],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        text=True,
        check=True,
    )
    files = {node: folder / f"ZigZag5-#0-{node}.pcap" for node in NODES}
    return Minute(
        json.loads(done.stdout)["outcomes"]["frames"], files, {n: read(f) for n, f in files.items()}
    )


def read(file: Path) -> list[Seen]:
    with PcapReader(str(file)) as reader:
        assert reader.nano
        assert reader.linktype == 127
        return [Seen(Decimal(str(p.time)), p, bytes(p.original)[p.len :]) for p in reader]


@pytest.mark.parametrize("kind", ["broadcast", "unicast", "rts", "cts", "ack"])
def test_as_many_frames_as_in_the_ledger(minute: Minute, kind: str) -> None:
    assert minute.count(kind, sent=True) == minute.copies(kind) / (len(NODES) - 1) > 0
    assert minute.count(kind, sent=False) == minute.copies(kind, "delivered") > 0
    assert minute.count(kind, sent=False, bad=True) == minute.copies(kind, "noise", "interference")


def test_some_frames_failed(minute: Minute) -> None:
    assert minute.copies("broadcast", "noise") > 0


def test_times_are_those_of_the_simulation(minute: Minute) -> None:
    for seen in minute.seen.values():
        times = [one.time_s for one in seen]
        assert times == sorted(times)
        assert all(0 <= time < 60 for time in times)


def test_a_frame_arrives_soon_after_it_was_sent(minute: Minute) -> None:
    sent = [one for seen in minute.seen.values() for one in seen if one.sent]
    for seen in minute.seen.values():
        for received in seen:
            if not received.sent:
                (origin,) = (
                    one
                    for one in sent
                    if 0 <= received.time_s - one.time_s < LONGEST_PROPAGATION_S
                    and one.frame[:-4] == received.frame[:-4]
                )
                assert (origin.frame == received.frame) is not received.bad


def test_the_fcs_is_right_except_where_flagged(minute: Minute) -> None:
    for seen in minute.seen.values():
        for one in seen:
            dot11 = one.packet[Dot11FCS]
            computed = dot11.compute_fcs(one.frame[:-4])
            assert (computed == one.frame[-4:]) is not one.bad


def test_the_radiotap_header(minute: Minute) -> None:
    for seen in minute.seen.values():
        for one in seen:
            radiotap = one.packet[RadioTap]
            assert radiotap.Rate == 24
            assert radiotap.ChannelFrequency == 2412
            assert radiotap.ChannelFlags == "OFDM+2GHz"
            assert radiotap.Flags.FCS
            if one.sent:
                assert radiotap.present.dBm_TX_Power
                assert one.packet.notdecoded == b"\x00"  # 0.95 mW are 0 dBm; scapy has no name for the field
            else:
                assert -85 <= radiotap.dBm_AntSignal < 0
                assert radiotap.dBm_AntNoise == -97


def test_checksums_and_lengths_of_the_datagrams(minute: Minute) -> None:
    data = [one for seen in minute.seen.values() for one in seen if one.kind in ("broadcast", "unicast")]
    for one in data:
        header = one.packet[IP]
        assert len(one.frame) == 64 + len(header[UDP].payload)
        rebuilt = header.copy()
        del rebuilt.chksum, rebuilt[UDP].chksum
        rebuilt = IP(bytes(rebuilt))
        assert (header.chksum, header[UDP].chksum) == (rebuilt.chksum, rebuilt[UDP].chksum)


def tshark(file: Path, *arguments: str) -> list[list[str]]:
    """Return the fields that tshark prints, line by line, and check that it reports no errors."""
    checks = [f"{name}.check_checksum:TRUE" for name in ("wlan", "ip", "udp")]
    options = [word for check in checks for word in ("-o", check)]
    done = subprocess.run(
        ["tshark", "-n", "-r", str(file), *options, *arguments], capture_output=True, text=True, check=True
    )
    complaints = [line for line in done.stderr.splitlines() if not line.startswith("Running as user")]
    assert complaints == []
    return [line.split("\t") for line in done.stdout.splitlines()]


@needs_tshark
@pytest.mark.parametrize("node", NODES)
def test_tshark_reads_every_frame(minute: Minute, node: str) -> None:
    fields = ["frame.time_epoch", "radiotap.flags.badfcs", "wlan.fcs.status"]
    lines = tshark(minute.files[node], "-T", "fields", *(word for field in fields for word in ("-e", field)))
    read_by_scapy = [
        [f"{one.time_s:.9f}", *(("1", "0") if one.bad else ("0", "1"))] for one in minute.seen[node]
    ]
    assert lines == read_by_scapy


@needs_tshark
@pytest.mark.parametrize("node", ["uavs[0]", "groundStation"])
def test_tshark_reads_the_messages(minute: Minute, node: str) -> None:
    fields = ["ip.src", "ip.checksum.status", "udp.checksum.status", "udp.payload"]
    lines = tshark(
        minute.files[node],
        *("-Y", "udp && radiotap.flags.badfcs == 0", "-T", "fields"),
        *(word for field in fields for word in ("-e", field)),
    )
    expected = [
        [one.packet[IP].src, "1", "1", bytes(one.packet[UDP].payload).hex()]
        for one in minute.seen[node]
        if one.kind in ("broadcast", "unicast") and not one.bad
    ]
    assert lines == expected
    types = Counter(json.loads(bytes.fromhex(line[3]))["type"] for line in lines)
    assert {"UavHeartbeat", "GroundStationHeartbeat"} & set(types)


@needs_tshark
@pytest.mark.parametrize("node", NODES)
def test_tshark_finds_fault_with_nothing_but_the_flagged_frames(minute: Minute, node: str) -> None:
    faulty = tshark(minute.files[node], "-Y", "_ws.expert", "-T", "fields", "-e", "frame.number")
    flagged = [[str(number)] for number, one in enumerate(minute.seen[node], start=1) if one.bad]
    assert faulty == flagged
