"""A beacon with a random delay for each message."""

from beacon import Beacon


class JitteredBeacon(Beacon):
    """Broadcasts like Beacon, but message number k is sent up to `jitter` after its time.

    Tracked variables, at the end: as in Beacon.
    """

    jitter: float = 0.0
    """Longest delay of a message in seconds, drawn for each message; not negative, less than `interval`."""

    def _schedule(self) -> None:
        time = self._start + self._sent * self.interval
        if time < self.stop:
            self.provider.schedule_timer("beacon", time + self.provider.random.uniform(0, self.jitter))
