"""Frames in a capture file of the engine. Read without scapy, which takes a hundred times as long."""

from dataclasses import dataclass
from pathlib import Path
from struct import unpack_from

_NANOSECONDS = 0xA1B23C4D
_SIGNAL, _TX_POWER = 1 << 5, 1 << 10
_FLAGS_RATE_CHANNEL = 1 << 1 | 1 << 2 | 1 << 3
_BAD_FCS = 0x40
_FILE_HEADER, _RECORD_HEADER, _FCS = 24, 16, 4


@dataclass(frozen=True)
class CapturedFrame:
    """One record of a file. The powers are None for a frame that the radio sent."""

    time_ns: int
    rate_mbps: float
    octets: bytes
    """Without the FCS."""
    decoded: bool
    signal_dbm: int | None
    noise_dbm: int | None

    @property
    def mpdu_bytes(self) -> int:
        """Length with the FCS."""
        return len(self.octets) + _FCS

    @property
    def kind(self) -> str:
        """Kind of frame, with its name in results."""
        first = self.octets[0]
        if first >> 2 & 3 == 1:
            return {11: "rts", 12: "cts", 13: "ack"}[first >> 4]
        return "broadcast" if self.octets[4:10] == b"\xff" * 6 else "unicast"


def read_capture(path: Path) -> list[CapturedFrame]:
    """Return all records, in the order of the file."""
    data = path.read_bytes()
    assert unpack_from("<I", data)[0] == _NANOSECONDS
    frames = []
    at = _FILE_HEADER
    while at < len(data):
        seconds, nanoseconds, length = unpack_from("<III", data, at)
        at += _RECORD_HEADER
        frames.append(_frame(seconds * 1_000_000_000 + nanoseconds, data[at : at + length]))
        at += length
    return frames


def _frame(time_ns: int, packet: bytes) -> CapturedFrame:
    header_bytes, present, flags, rate = unpack_from("<HIBB", packet, 2)
    received = bool(present & _SIGNAL)
    assert present & _FLAGS_RATE_CHANNEL == _FLAGS_RATE_CHANNEL
    assert received is not bool(present & _TX_POWER)
    signal_dbm, noise_dbm = unpack_from("<bb", packet, 14) if received else (None, None)
    octets = packet[header_bytes:-_FCS]
    return CapturedFrame(time_ns, rate / 2, octets, not flags & _BAD_FCS, signal_dbm, noise_dbm)
