"""Channel access: the channel state of the oracle against the times at which a station sends.

Waiting times are part of the MAC, and not computed here. But two statements follow from the channel state
that the radio reports to the MAC:

- No exchange starts before the channel has been free for DIFS.
- If all frames are broadcasts and the channel has been free for longer than any wait, a message is sent at
  once (immediate access).

So the tests detect a radio that misses energy, and one that senses energy without a source.
"""

from collections.abc import Iterator, Sequence

from verification.oracle.captured_frame import CapturedFrame
from verification.oracle.case import Case
from verification.oracle.radio import Heard

DIFS_US = {"b": 50, "g(mixed)": 50, "g(erp)": 28, "a": 34}
LONGEST_WAIT_US = 1000
"""More than EIFS and a first backoff: 364 µs + 31 · 20 µs in b and g(mixed), less in other modes."""
UNNOTICED_NS = 1
"""A frame that starts this shortly before the end of a slot does not delay the station."""


def differences_in_access(
    case: Case, index: int, sent: Sequence[CapturedFrame], heard: Heard
) -> Iterator[str]:
    """Yield actions of a station that contradict the channel state."""
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
        # Arrivals at the same instant come before the message.
        busy_ps = _busy_between(heard, send.time_ns - LONGEST_WAIT_US * 1000, send.time_ns + 1)
        if is_alone and not busy_ps and send.time_ns not in begun_ns:
            yield f"station {index} does not send at {send.time_ns} ns; its channel was free"


def _begins_an_exchange(frame: CapturedFrame, case: Case) -> bool:
    """Return whether it must wait for a free channel. Answers do not, nor frames that follow an RTS."""
    if frame.kind == "unicast":
        return frame.mpdu_bytes < case.rts_threshold_bytes
    return frame.kind in ("broadcast", "rts")


def _busy_between(heard: Heard, start_ns: int, end_ns: int) -> list[tuple[int, int]]:
    """Return when the channel was busy between two times, the first of which is truncated to nanoseconds."""
    return [
        (start_ps, end_ps)
        for start_ps, end_ps in heard.busy_ps
        if start_ps < end_ns * 1000 and (start_ns + 1) * 1000 < end_ps
    ]
