"""The clock of a node, which runs fast or slow."""

from gradysim.protocol.interface import IProvider


def let_clock_drift(provider: IProvider, rate: float) -> None:
    """Make the clock of a provider show `(1 + rate) * t` at simulated time t, > -1. Its timers follow it.

    0 leaves the provider as it is.
    """
    if rate == 0:
        return
    simulated_time, schedule = provider.current_time, provider.schedule_timer
    factor = 1 + rate

    def current_time() -> float:
        return simulated_time() * factor

    def schedule_timer(timer: str, timestamp: float) -> None:
        due = timestamp / factor
        if timestamp >= current_time():  # rounding must not move it into the past
            due = max(due, simulated_time())
        schedule(timer, due)

    for method in (current_time, schedule_timer):
        setattr(provider, method.__name__, method)
