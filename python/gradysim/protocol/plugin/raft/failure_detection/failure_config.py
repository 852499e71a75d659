"""Settings of the failure detection: when a node counts as failed, and when as recovered."""

import warnings

from gradysim.protocol.checked_values import checked_number

_MINIMUM_TIMEOUT_MS = 100
_RISKY_TIMEOUT_MS = 50


class FailureConfig:
    """Thresholds of the failure detection.

    Each node is checked every `detection_interval` heartbeats. A check fails if the node has been silent for
    longer than the timeout. After `failure_threshold` failed checks in a row, the node counts as failed.
    After `recovery_threshold` answers in a row, it is active again.

    The timeout is a multiple of the heartbeat interval (4 by default), or absolute.
    """

    def __init__(self) -> None:
        self._failure_threshold = 3
        self._recovery_threshold = 2
        self._detection_interval = 2
        self._timeout_multiplier = 4
        self._heartbeat_interval_ms: int | None = None
        self._absolute_timeout_ms: int | None = None

    def set_failure_threshold(self, threshold: int) -> None:
        """Set the number of failed checks in a row after which a node has failed. Raise ValueError if < 1."""
        self._failure_threshold = _at_least_one("failure_threshold", threshold)

    def set_recovery_threshold(self, threshold: int) -> None:
        """Set the number of answers in a row after which a node is active again. Raise ValueError if < 1."""
        self._recovery_threshold = _at_least_one("recovery_threshold", threshold)

    def set_detection_interval(self, interval: int) -> None:
        """Set the number of heartbeats from one check to the next. Raise ValueError if < 1."""
        self._detection_interval = _at_least_one("detection_interval", interval)

    def set_heartbeat_timeout(self, multiplier: int) -> None:
        """Set the timeout as a multiple of the heartbeat interval.

        Raise ValueError if it is < 1, or the timeout would be shorter than 100 ms.
        """
        _at_least_one("timeout multiplier", multiplier)
        if self._heartbeat_interval_ms is not None:
            _check_timeout(multiplier, self._heartbeat_interval_ms)
        self._timeout_multiplier = multiplier
        self._absolute_timeout_ms = None

    def set_absolute_timeout(self, timeout_ms: int) -> None:
        """Set the timeout in ms, independent of the heartbeat interval. Raise ValueError if it is <= 0.

        Warn (UserWarning) below 50 ms: normal delays may look like failures.
        """
        checked_number("an absolute timeout", timeout_ms, 0, above=True, infinite=True, unit="ms")
        if timeout_ms < _RISKY_TIMEOUT_MS:
            warnings.warn(
                f"with a timeout of {timeout_ms} ms normal delays may look like failures", stacklevel=2
            )
        self._absolute_timeout_ms = timeout_ms

    def set_heartbeat_interval_reference(self, interval_ms: int) -> None:
        """Set the heartbeat interval in ms.

        Raise ValueError if it is <= 0, or the timeout would be shorter than 100 ms.
        """
        checked_number("a heartbeat interval", interval_ms, 0, above=True, infinite=True, unit="ms")
        if not self.is_using_absolute_timeout():
            _check_timeout(self._timeout_multiplier, interval_ms)
        self._heartbeat_interval_ms = interval_ms

    def get_heartbeat_interval_reference(self) -> int | None:
        """Return the heartbeat interval in ms; None if it was never set."""
        return self._heartbeat_interval_ms

    def get_timeout_multiplier(self) -> int | None:
        """Return the multiple of the heartbeat interval; None if the timeout is absolute."""
        return None if self.is_using_absolute_timeout() else self._timeout_multiplier

    def get_absolute_timeout_ms(self) -> int | None:
        """Return the absolute timeout in ms; None if it is a multiple of the heartbeat interval."""
        return self._absolute_timeout_ms

    def is_using_absolute_timeout(self) -> bool:
        """Whether the timeout is absolute."""
        return self._absolute_timeout_ms is not None

    def get_timeout_ms(self) -> int:
        """Return the timeout in ms. Raise ValueError if it is a multiple of an interval that was not set."""
        if self._absolute_timeout_ms is not None:
            return self._absolute_timeout_ms
        if self._heartbeat_interval_ms is None:
            raise ValueError(
                f"the timeout is {self._timeout_multiplier} heartbeat intervals, but the interval is not "
                "set: call set_heartbeat_interval_reference"
            )
        return self._timeout_multiplier * self._heartbeat_interval_ms

    @property
    def failure_threshold(self) -> int:
        """Number of failed checks in a row after which a node has failed."""
        return self._failure_threshold

    @property
    def recovery_threshold(self) -> int:
        """Number of answers in a row after which a node is active again."""
        return self._recovery_threshold

    @property
    def detection_interval(self) -> int:
        """Number of heartbeats from one check to the next."""
        return self._detection_interval

    heartbeat_timeout_ms = property(get_timeout_ms)

    def __str__(self) -> str:
        if self._absolute_timeout_ms is not None:
            timeout = f"{self._absolute_timeout_ms}ms"
        elif self._heartbeat_interval_ms is not None:
            timeout = f"{self._timeout_multiplier}x{self._heartbeat_interval_ms}ms={self.get_timeout_ms()}ms"
        else:
            timeout = f"{self._timeout_multiplier} heartbeat intervals"
        return (
            f"FailureConfig(failure_threshold={self._failure_threshold}, "
            f"recovery_threshold={self._recovery_threshold}, "
            f"detection_interval={self._detection_interval}, timeout={timeout})"
        )


def _at_least_one(name: str, value: int) -> int:
    if not isinstance(value, int) or isinstance(value, bool) or value < 1:
        raise ValueError(f"{name} must be an integer >= 1, got {value!r}")
    return value


def _check_timeout(multiplier: int, interval_ms: int) -> None:
    if multiplier * interval_ms < _MINIMUM_TIMEOUT_MS:
        raise ValueError(
            f"a timeout must be at least {_MINIMUM_TIMEOUT_MS} ms, {multiplier} heartbeat intervals of "
            f"{interval_ms} ms are {multiplier * interval_ms} ms"
        )
