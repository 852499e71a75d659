"""Cases by seed: networks in which all features of the oracle occur often.

Stations at random places, in networks from a meter (few: a centimeter) to kilometers wide, send in bursts.
Many of them are deaf, so that they send while others do. For thresholds that are met exactly see
`exact_case`.
"""

from dataclasses import dataclass, replace
from math import dist
from random import Random
from typing import Any

from verification.nist import DSSS_RATES_MBPS, OFDM_RATES_MBPS
from verification.oracle.case import (
    BREAKPOINT,
    IEEE80211,
    NARROWBAND,
    Air,
    Case,
    Course,
    FrameCapture,
    Point,
    PreambleDetection,
    Receiver,
    Send,
    Station,
)
from verification.oracle.physics import BOLTZMANN_J_PER_K, gain, noise_w

RATES_MBPS = {
    "b": DSSS_RATES_MBPS,
    "g(erp)": OFDM_RATES_MBPS,
    "g(mixed)": DSSS_RATES_MBPS + OFDM_RATES_MBPS,
    "a": OFDM_RATES_MBPS,
}
CARRIERS_HZ = (2.412e9, 2.437e9, 2.422e9)
"""The third overlaps with both others."""
BANDWIDTH_HZ = 22e6
BURST_NS = 4_000_000
DEAF_W = 1e9
"""More than any received power: a station with that sensitivity never waits."""


def random_case(seed: int) -> Case:
    """Return the case of that seed."""
    draw = Random(seed)
    style = _Style.drawn(draw)
    stations = [_station(draw, style, index) for index in range(style.count)]
    stations = _on_the_edge(draw, style, stations)
    return Case(seed, draw.choice([2346, 2346, 200]), style.air, tuple(stations))


@dataclass(frozen=True)
class _Style:
    """Common properties of the stations of a network."""

    count: int
    op_modes: tuple[str, ...]
    """One for all stations, or several to draw from."""
    size_m: float
    sensitivity_w: float
    tx_power_w: float
    air: Air
    bands: int
    bursts: int
    snir_threshold: float
    unicast: float
    """Ratio of messages; the following are ratios of stations."""
    deaf: float
    flying: float
    by_chunks: float
    detecting: float
    capturing: float
    on_the_edge: float

    @classmethod
    def drawn(cls, draw: Random) -> "_Style":
        size_m = _wide(draw, 0, 3.7) if draw.random() < 0.97 else _wide(draw, -2, 0)
        sensitivity_w = 10**-11.5 if draw.random() < 0.5 else _wide(draw, -13, -9)
        air = _air(draw, sensitivity_w)
        # Typical arrivals are about as strong as necessary, or stronger.
        at_half_w = sensitivity_w * _wide(draw, -0.5, 2.5)
        return cls(
            count=draw.randint(2, 12) if draw.random() < 0.99 else draw.randint(30, 60),
            op_modes=tuple(RATES_MBPS) if draw.random() < 0.3 else (draw.choice([*RATES_MBPS, "g(mixed)"]),),
            size_m=size_m,
            sensitivity_w=sensitivity_w,
            tx_power_w=at_half_w / gain(air, size_m / 2, CARRIERS_HZ[0]),
            air=air,
            bands=draw.choice([1, 1, 1, 2, 3]),
            bursts=draw.randint(2, 8),
            snir_threshold=10**0.4 if draw.random() < 0.6 else _wide(draw, -1, 1.5),
            unicast=draw.choice([0, 0, 0.4]),
            deaf=draw.choice([0, 0.3, 0.7]),
            flying=draw.choice([0, 0, 0.7]),
            by_chunks=draw.choice([0, 0, 0.7]),
            detecting=draw.choice([0, 0, 0.7]),
            capturing=draw.choice([0, 0, 0.7]),
            on_the_edge=draw.choice([0, 0.3]),
        )


def _wide(draw: Random, low: float, high: float) -> float:
    """Return a number between two powers of ten."""
    return float(10 ** draw.uniform(low, high))


def _air(draw: Random, sensitivity_w: float) -> Air:
    medium = draw.choice([IEEE80211, NARROWBAND])
    wanted_w = draw.choice([1e-14, 10**-12.6616, sensitivity_w * _wide(draw, -3, -0.3)])
    return Air(
        medium=medium,
        free_space_alpha=None if medium == NARROWBAND else draw.choice([2.0, 2.0, draw.uniform(1.8, 4)]),
        breakpoint=BREAKPOINT
        if draw.random() < 0.7
        else (_wide(draw, 0, 2), draw.uniform(30, 50), draw.uniform(50, 70), 2.0, draw.uniform(2, 4)),
        noise_w=wanted_w,
        temperature_k=wanted_w / (BOLTZMANN_J_PER_K * BANDWIDTH_HZ) if draw.random() < 0.2 else None,
    )


def _station(draw: Random, style: _Style, index: int) -> Station:
    op_mode = draw.choice(style.op_modes)
    rate_mbps = draw.choice(RATES_MBPS[op_mode])
    bare = Station(
        position=_point(draw, style.size_m),
        tx_power_w=style.tx_power_w * _wide(draw, -1, 1),
        carrier_hz=draw.choice(CARRIERS_HZ[: style.bands]),
        bandwidth_hz=BANDWIDTH_HZ if style.bands == 1 else draw.choice([20e6, BANDWIDTH_HZ]),
        op_mode=op_mode,
        bitrate_mbps=rate_mbps,
        receiver=_receiver(draw, style),
        sends=tuple(_sends(draw, style, index, rate_mbps)),
        courses=tuple(_courses(draw, style)) if draw.random() < style.flying else (),
    )
    # The engine requires a channel that is free without transmissions.
    least_w = 1.5 * noise_w(style.air, bare)
    return _changed(bare, energy_detection_w=max(bare.receiver.energy_detection_w, least_w))


def _changed(station: Station, **fields: Any) -> Station:
    return replace(station, receiver=replace(station.receiver, **fields))


def _on_the_edge(draw: Random, style: _Style, stations: list[Station]) -> list[Station]:
    """Give some stations levels and thresholds that one of the others just meets, or just misses."""
    edged = []
    for station in stations:
        sender = draw.choice(stations)
        distance_m = dist(sender.position, station.position)
        power_w = sender.tx_power_w * gain(style.air, distance_m, sender.carrier_hz)
        nearly = 1 + draw.choice([-1, 1]) * _wide(draw, -7, -2)
        own_noise_w = noise_w(style.air, station)
        if draw.random() < style.on_the_edge and station.receiver.sensitivity_w < DEAF_W:
            station = _changed(station, sensitivity_w=power_w * nearly)
        elif draw.random() < style.on_the_edge:
            station = _changed(station, snir_threshold=power_w / own_noise_w * nearly)
        if draw.random() < style.on_the_edge:
            energy_w = own_noise_w + power_w * nearly
            station = _changed(station, energy_detection_w=max(energy_w, 1.001 * own_noise_w))
        edged.append(station)
    return edged


def _point(draw: Random, size_m: float) -> Point:
    return draw.uniform(0, size_m), draw.uniform(0, size_m), draw.uniform(0, size_m / 4)


def _receiver(draw: Random, style: _Style) -> Receiver:
    is_deaf = draw.random() < style.deaf
    own_w = style.sensitivity_w * (1.0 if draw.random() < 0.7 else _wide(draw, -1, 1))
    return Receiver(
        sensitivity_w=DEAF_W if is_deaf else own_w,
        energy_detection_w=DEAF_W if is_deaf and draw.random() < 0.7 else own_w * _wide(draw, -0.5, 2),
        snir_threshold=style.snir_threshold,
        noise_figure=draw.choice([1.0, 1.0, _wide(draw, 0, 1)]),
        by_chunks=draw.random() < style.by_chunks,
        preamble_detection=PreambleDetection(
            threshold=draw.choice([10**0.4, _wide(draw, -1, 1)]),
            minimum_power_w=own_w * _wide(draw, -0.5, 1),
            duration_us=draw.choice([4, 4, 1, 10, 19, 25]),
        )
        if draw.random() < style.detecting
        else None,
        frame_capture=FrameCapture(
            margin=draw.choice([10**0.5, _wide(draw, 0, 1)]), window_us=draw.choice([16, 16, 4, 50, 1000])
        )
        if draw.random() < style.capturing
        else None,
    )


def _sends(draw: Random, style: _Style, index: int, rate_mbps: float) -> list[Send]:
    """Return at most one for each burst, short enough to end soon."""
    sends = []
    most_bytes = min(1400.0, 150 * rate_mbps)
    others = [other for other in range(style.count) if other != index]
    for burst in range(style.bursts):
        if draw.random() < 0.5:
            within_ns = draw.choice([0, 20_000, 20_000, 100_000, 1_000_000])
            sends.append(
                Send(
                    time_ns=(burst + 1) * BURST_NS + draw.randint(0, within_ns),
                    payload_bytes=round(10 * (most_bytes / 10) ** draw.random()),
                    destination=draw.choice(others) if draw.random() < style.unicast else None,
                )
            )
    return sends


def _courses(draw: Random, style: _Style) -> list[Course]:
    """Return fast flights; otherwise distances would hardly change during a frame."""
    end_ns = (style.bursts + 1) * BURST_NS
    crossing_mps = style.size_m / (end_ns * 1e-9)
    return [
        Course(draw.randint(0, end_ns), _point(draw, style.size_m), crossing_mps * _wide(draw, -1, 1))
        for _ in range(draw.randint(1, 3))
    ]
