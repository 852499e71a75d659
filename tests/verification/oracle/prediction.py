"""What the model text says that every radio receives, given what was sent."""

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import dist

from gradysim.encapsulator.random_stream import RandomStream
from verification.oracle.captured_frame import CapturedFrame
from verification.oracle.case import Case, Station
from verification.oracle.engine_run import EngineRun
from verification.oracle.flight import Flight
from verification.oracle.physics import delay_ps, frame_format, gain, noise_w
from verification.oracle.radio import Arrival, Heard, Radio, Transmission

RECEPTION = 2
"""The number of the random streams from which receptions are drawn."""


@dataclass(frozen=True)
class Prediction:
    """By station."""

    heard: list[Heard]
    certain: list[bool]
    """Whether all that counts at that station is known: the order of events, that is."""
    noise_w: list[float]
    below_sensitivity: int
    """Copies at all stations."""


def predict(case: Case, run: EngineRun) -> Prediction:
    """Take from the run what was sent, and work out the rest."""
    transmissions = _transmissions(case, run)
    flights = [Flight(station) for station in case.stations]
    heard, certain, noises_w, below_sensitivity = [], [], [], 0
    for index, station in enumerate(case.stations):
        own = [sent for sent in transmissions if sent.sender == index]
        arrivals = [
            _arrival(case, flights, sent, index)
            for sent in transmissions
            if sent.sender != index and _is_in_band(case.stations[sent.sender], station)
        ]
        noise = noise_w(case.air, station)
        draws = RandomStream(case.seed, index, RECEPTION)
        heard.append(Radio(station.receiver, noise, draws, arrivals, own).heard)
        certain.append(_is_certain(arrivals, own))
        noises_w.append(noise)
        below_sensitivity += sum(arrival.power_w < station.receiver.sensitivity_w for arrival in arrivals)
    return Prediction(heard, certain, noises_w, below_sensitivity)


def _transmissions(case: Case, run: EngineRun) -> list[Transmission]:
    starts = [
        (*_start(case.stations[sender], frame, run.instants_ps), sender, frame)
        for sender, frames in enumerate(run.sent)
        for frame in frames
    ]
    starts.sort(key=lambda start: (start[0], start[2]))
    return [
        Transmission(
            order=order,
            sender=sender,
            start_ps=start_ps,
            slack_ps=slack_ps,
            kind=frame.kind,
            octets=frame.octets,
            format=frame_format(case.op_mode, frame.rate_mbps, frame.mpdu_bytes),
        )
        for order, (start_ps, slack_ps, sender, frame) in enumerate(starts)
    ]


def _start(station: Station, frame: CapturedFrame, instants_ps: Sequence[int]) -> tuple[int, int]:
    """The start of a frame and how much later it may have been, both in picoseconds."""
    captured_ps = frame.time_ns * 1000
    first = bisect_left(instants_ps, captured_ps)
    possible = instants_ps[first : bisect_left(instants_ps, captured_ps + 1000)]
    assert possible, f"nothing happened at {frame.time_ns} ns"
    if captured_ps in possible and any(send.time_ns == frame.time_ns for send in station.sends):
        return captured_ps, 0
    return possible[0], possible[-1] - possible[0]


def _arrival(case: Case, flights: Sequence[Flight], sent: Transmission, receiver: int) -> Arrival:
    """Both ends of the way are where they are when the transmission starts."""
    sender = case.stations[sent.sender]
    distance_m = dist(
        flights[sent.sender].position_at(sent.start_ps), flights[receiver].position_at(sent.start_ps)
    )
    power_w = sender.tx_power_w * gain(case.air, distance_m, sender.carrier_hz)
    return Arrival(sent, sent.start_ps + delay_ps(distance_m), power_w)


def _is_in_band(sender: Station, receiver: Station) -> bool:
    return sender.carrier_hz == receiver.carrier_hz and sender.bandwidth_hz <= receiver.bandwidth_hz


def _is_certain(arrivals: Sequence[Arrival], own: Sequence[Transmission]) -> bool:
    """Whether no two events are so near that a start which is not known exactly changes their order."""
    events = sorted(
        (time_ps, part.slack_ps, part.order)
        for part, times in [
            *((arrival.sent, (arrival.start_ps, arrival.end_ps)) for arrival in arrivals),
            *((sent, (sent.start_ps, sent.end_ps)) for sent in own),
        ]
        for time_ps in times
    )
    return not any(
        order != other_order and other_ps - time_ps <= slack_ps + other_slack_ps and slack_ps + other_slack_ps
        for (time_ps, slack_ps, order), (other_ps, other_slack_ps, other_order) in pairwise(events)
    )
