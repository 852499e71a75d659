"""An asyncio loop whose time is that of vehicles in lock-step: it passes when they fly, and only then.

So the steps of a `Vehicle`, with their limits of time, are the same for autopilots on simulated time as for
those on the wall's; only here they are repeatable.
"""

import asyncio

from gradysim.sitl.nested_loop import outer_loop_stands

_HOPS = 12
"""Rounds of callbacks for each turn: as many as it takes from a message to the next order, and some more."""


class VehicleClockLoop(asyncio.SelectorEventLoop):
    """Never sleeps. Has to be closed, by `cancel_all`."""

    def __init__(self) -> None:
        super().__init__()
        self._now_s = 0.0
        self._hops_left = 0

    def time(self) -> float:
        """Return the vehicles' time in seconds."""
        return self._now_s

    def turn(self, now_s: float) -> None:
        """Do what has become possible, and what is due by `now_s`, which is the time from now on."""
        self._now_s = now_s
        self._hops_left = _HOPS
        self.call_soon(self._hop)
        with outer_loop_stands():
            self.run_forever()

    def cancel_all(self) -> None:
        """Cancel all tasks, let them finish, and close the loop; no-op if that has happened."""
        if self.is_closed():
            return
        for task in asyncio.all_tasks(self):
            task.cancel()
        self.turn(self._now_s)
        self.close()

    def _hop(self) -> None:
        self._hops_left -= 1
        if self._hops_left == 0:
            self.stop()
        else:
            self.call_soon(self._hop)
