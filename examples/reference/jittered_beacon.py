"""A beacon each of whose messages is late by a random time of its own."""

from beacon import Beacon


class JitteredBeacon(Beacon):
    """Broadcasts as Beacon does, but message number k goes out up to `jitter` after its time.

    Tracked variables, at the end: those of Beacon.
    """

    jitter: float = 0.0
    """Longest delay of a message in seconds, drawn anew for each; not negative, less than `interval`."""

    def _schedule(self) -> None:
        time = self._start + self._sent * self.interval
        if time < self.stop:
            self.provider.schedule_timer("beacon", time + self.provider.random.uniform(0, self.jitter))
