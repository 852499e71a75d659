"""What the oracle knows of a station's channel, against the moments at which the station sends.

How long a station waits is the MAC's business, and not worked out here. But of what the radio tells the MAC,
busy or free, two things follow:

- No exchange begins before the channel has been free for DIFS.
- Where all frames are broadcasts, a message that meets a channel which has been free for longer than any wait
  leaves at once (immediate access).

So a radio that misses some energy is found out, and one that senses some which is not there.
"""

from collections.abc import Iterator, Sequence

from verification.oracle.captured_frame import CapturedFrame
from verification.oracle.case import Case
from verification.oracle.radio import Heard

DIFS_US = {"b": 50, "g(mixed)": 50, "g(erp)": 28, "a": 34}
LONGEST_WAIT_US = 1000
"""More than EIFS and a first backoff: 364 µs + 31 · 20 µs in b and g(mixed), less in the others."""
UNNOTICED_NS = 1
"""What begins so shortly before the end of a slot does not hold the station back."""


def differences_in_access(
    case: Case, index: int, sent: Sequence[CapturedFrame], heard: Heard
) -> Iterator[str]:
    """What a station cannot have done, with that channel."""
    for frame in sent:
        busy_ps = _busy_between(
            heard, frame.time_ns - DIFS_US[case.stations[index].op_mode] * 1000, frame.time_ns - UNNOTICED_NS
        )
        if _begins_an_exchange(frame, case) and busy_ps:
            yield f"station {index} sends at {frame.time_ns} ns; its channel was busy, {busy_ps} ps"
    if any(send.destination is not None for station in case.stations for send in station.sends):
        return
    begun_ns = {frame.time_ns for frame in sent}
    for number, send in enumerate(sorted(case.stations[index].sends, key=lambda send: send.time_ns)):
        is_alone = sum(frame.time_ns < send.time_ns for frame in sent) == number
        # What comes in the same instant comes before the message.
        busy_ps = _busy_between(heard, send.time_ns - LONGEST_WAIT_US * 1000, send.time_ns + 1)
        if is_alone and not busy_ps and send.time_ns not in begun_ns:
            yield f"station {index} does not send at {send.time_ns} ns; its channel was free"


def _begins_an_exchange(frame: CapturedFrame, case: Case) -> bool:
    """Whether it has to wait for a free channel: no answer does, nor what follows an RTS."""
    if frame.kind == "unicast":
        return frame.mpdu_bytes < case.rts_threshold_bytes
    return frame.kind in ("broadcast", "rts")


def _busy_between(heard: Heard, start_ns: int, end_ns: int) -> list[tuple[int, int]]:
    """When the channel was busy between two times, of which the first was cut to nanoseconds."""
    return [
        (start_ps, end_ps)
        for start_ps, end_ps in heard.busy_ps
        if start_ps < end_ns * 1000 and (start_ns + 1) * 1000 < end_ps
    ]
