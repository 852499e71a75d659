"""When the positions of a simulation are updated."""

from bisect import bisect_left


class UpdateTimes:
    """The times of periodic updates, counted from a start, so that rounding does not add up."""

    def __init__(self, update_rate_s: float, start_s: float = 0.0) -> None:
        """Let the first update come one `update_rate_s`, > 0, after `start_s`; simulated seconds."""
        self._update_rate_s = update_rate_s
        self._frequency = _whole_frequency(update_rate_s)
        self._start_s = start_s

    def time_of(self, update: int) -> float:
        """Return the simulated time in seconds of an update, the first one being 1."""
        if self._frequency is None:
            return self._start_s + update * self._update_rate_s
        return self._start_s + update / self._frequency

    def last_before(self, timestamp: float, updates: range) -> int:
        """Return the last of these updates that comes before a time; the first of them if none does."""
        return updates[max(bisect_left(updates, timestamp, key=self.time_of) - 1, 0)]


def _whole_frequency(update_rate_s: float) -> float | None:
    """Updates per second, if that is a whole number.

    35 / 100 is the number written 0.35 and 35 * 0.01 is not: by division updates meet timers of that time.
    """
    if update_rate_s < 1e-9:
        return None
    frequency = round(1 / update_rate_s)
    return float(frequency) if frequency > 0 and 1 / frequency == update_rate_s else None
