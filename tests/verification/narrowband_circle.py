"""Stations on a circle of 5 m around a sink, as settings for narrowband_contention.ini."""

from math import cos, pi, sin


def circle(stations: int, acks: bool) -> list[str]:
    """Return the overrides for that many stations."""
    return [
        f"*.stations.count = {stations}",
        f"**.wlan[*].mac.useMACAcks = {str(acks).lower()}",
        *(
            f"*.stations[{index}].mobility.initial{axis} = {5 * of(2 * pi * index / stations):.6f}m"
            for index in range(stations)
            for axis, of in (("X", cos), ("Y", sin))
        ),
    ]
