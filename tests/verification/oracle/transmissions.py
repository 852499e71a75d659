"""Sent frames with times exact to the picosecond, and their arrivals.

Captures are truncated to nanoseconds. So the start is one of the times within that nanosecond at which the
engine had an event. If there are several, it helps that all waits of a MAC are integers of microseconds,
counted from an earlier event at the station.
"""

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import dist

from verification.oracle.captured_frame import CapturedFrame
from verification.oracle.case import Case, Station
from verification.oracle.engine_run import EngineRun
from verification.oracle.flight import Flight
from verification.oracle.physics import delay_ps, frame_format, gain, knows_format
from verification.oracle.radio import Arrival, Transmission

PS_PER_US = 1_000_000
LONGEST_WAIT_PS = 20_000 * PS_PER_US


def transmissions(case: Case, run: EngineRun, flights: Sequence[Flight]) -> list[Transmission]:
    """Return all transmissions of a run, by start; at equal times the lower station comes first."""
    captured = sorted(
        ((frame, sender) for sender, frames in enumerate(run.sent) for frame in frames),
        key=lambda pair: (pair[0].time_ns, pair[1]),
    )
    found: list[Transmission] = []
    for frame, sender in captured:
        possible_ps = _possible_starts(case.stations[sender], frame, run.instants_ps)
        if len(possible_ps) > 1:
            rests = {time_ps % PS_PER_US for time_ps in _happened_at(case, flights, found, sender)}
            likely_ps = [time_ps for time_ps in possible_ps if time_ps % PS_PER_US in rests]
            possible_ps = likely_ps or possible_ps
        found.append(
            Transmission(
                order=0,
                sender=sender,
                start_ps=possible_ps[0],
                slack_ps=possible_ps[-1] - possible_ps[0],
                kind=frame.kind,
                octets=frame.octets,
                format=frame_format(case.stations[sender].op_mode, frame.rate_mbps, frame.mpdu_bytes),
            )
        )
    found.sort(key=lambda sent: (sent.start_ps, sent.sender))
    return [replace(sent, order=order) for order, sent in enumerate(found)]


def arrival_at(case: Case, flights: Sequence[Flight], sent: Transmission, receiver: int) -> Arrival:
    """Both ends of the path have their positions at the start of the transmission."""
    sender = case.stations[sent.sender]
    distance_m = dist(
        flights[sent.sender].position_at(sent.start_ps), flights[receiver].position_at(sent.start_ps)
    )
    there = case.stations[receiver]
    is_of_channel = sender.carrier_hz == there.carrier_hz and sender.bandwidth_hz <= there.bandwidth_hz
    power_w = sender.tx_power_w * share_in_band(sender, there) * gain(case.air, distance_m, sender.carrier_hz)
    is_known = knows_format(there.op_mode, sender.op_mode, sent.format.rate_mbps)
    return Arrival(sent, sent.start_ps + delay_ps(distance_m), power_w, is_of_channel and is_known)


def share_in_band(sender: Station, receiver: Station) -> float:
    """Return the part of a power, spread evenly over the sender's band, in the receiver's band."""
    edges = [
        (station.carrier_hz - station.bandwidth_hz / 2, station.carrier_hz + station.bandwidth_hz / 2)
        for station in (sender, receiver)
    ]
    low, high = max(low for low, _ in edges), min(high for _, high in edges)
    return max(high - low, 0.0) / sender.bandwidth_hz


def _possible_starts(station: Station, frame: CapturedFrame, instants_ps: Sequence[int]) -> Sequence[int]:
    captured_ps = frame.time_ns * 1000
    first = bisect_left(instants_ps, captured_ps)
    possible_ps = instants_ps[first : bisect_left(instants_ps, captured_ps + 1000)]
    assert possible_ps, f"nothing happened at {frame.time_ns} ns"
    is_planned = any(send.time_ns == frame.time_ns for send in station.sends)
    return [captured_ps] if is_planned and captured_ps in possible_ps else possible_ps


def _happened_at(
    case: Case, flights: Sequence[Flight], found: Sequence[Transmission], station: int
) -> Iterator[int]:
    """Return starts at that station, and ends up to integers of microseconds, of recent transmissions."""
    for sent in found:
        if sent.end_ps < found[-1].start_ps - LONGEST_WAIT_PS or sent.slack_ps:
            continue
        if sent.sender == station:
            yield sent.start_ps
        elif share_in_band(case.stations[sent.sender], case.stations[station]) > 0:
            yield arrival_at(case, flights, sent, station).start_ps
