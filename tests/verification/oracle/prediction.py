"""Receptions of every radio that follow from the model text and the sent frames."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from gradysim.encapsulator.random_stream import RandomStream
from verification.oracle.case import Case
from verification.oracle.engine_run import EngineRun
from verification.oracle.flight import Flight
from verification.oracle.physics import noise_w
from verification.oracle.radio import Arrival, Heard, Radio, Transmission
from verification.oracle.transmissions import arrival_at, share_in_band, transmissions

RECEPTION = 2
"""Number of the random streams for receptions."""


@dataclass(frozen=True)
class Prediction:
    """Results by station."""

    heard: list[Heard]
    certain: list[bool]
    """Whether the order of all relevant events at that station is known."""
    noise_w: list[float]
    below_sensitivity: int
    """Receptions at all stations."""


def predict(case: Case, run: EngineRun) -> Prediction:
    """Take the sent frames from the run, and compute the rest."""
    flights = [Flight(station) for station in case.stations]
    all_sent = transmissions(case, run, flights)
    heard, certain, noises_w, below_sensitivity = [], [], [], 0
    for index, station in enumerate(case.stations):
        own = [sent for sent in all_sent if sent.sender == index]
        arrivals = [
            arrival_at(case, flights, sent, index)
            for sent in all_sent
            if sent.sender != index and share_in_band(case.stations[sent.sender], station) > 0
        ]
        noise = noise_w(case.air, station)
        draws = RandomStream(case.seed, index, RECEPTION)
        heard.append(Radio(station.receiver, noise, draws, arrivals, own).heard)
        certain.append(_is_certain(arrivals, own))
        noises_w.append(noise)
        below_sensitivity += sum(
            arrival.is_decodable and arrival.power_w < station.receiver.sensitivity_w for arrival in arrivals
        )
    return Prediction(heard, certain, noises_w, below_sensitivity)


def _is_certain(arrivals: Sequence[Arrival], own: Sequence[Transmission]) -> bool:
    """Return whether no two events are so near that an inexact start changes their order."""
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
