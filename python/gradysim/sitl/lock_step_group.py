"""Autopilots in lock-step that fly at the same time, each as fast as it can."""

import selectors
import time
from collections.abc import Sequence
from typing import cast

from gradysim.sitl.lock_step import PATIENCE_S, LockStepAutopilot

_SILENCE_S = 10.0
"""Wall time without a step after which an autopilot is given up; it says something at least once a second."""


class LockStepGroup:
    """Some autopilots that have been met."""

    def __init__(self, autopilots: Sequence[LockStepAutopilot]) -> None:
        self._autopilots = autopilots
        self._selector = selectors.DefaultSelector()
        for autopilot in autopilots:
            self._selector.register(autopilot, selectors.EVENT_READ)

    def fly_to(self, time_s: float) -> bool:
        """Let all take the steps up to the one nearest to `time_s`; whether one said something.

        What they said is passed on when all are there, in their order: it makes no difference which one is
        fastest.

        Raises:
            SitlError: One of them is gone, or hangs.
        """
        behind = [each for each in self._autopilots if each.is_at_work or each.is_behind(time_s)]
        for autopilot in behind:
            if not autopilot.is_at_work:  # unless Ctrl-C came in between
                autopilot.answer()
        last_sign_s = time.monotonic()
        while behind:
            has_gone_on = False
            for key, _ in self._selector.select(PATIENCE_S):
                autopilot = cast(LockStepAutopilot, key.fileobj)
                if autopilot.take_wish():  # and no repetition, by one that waits for the others
                    has_gone_on = True
                    if autopilot.is_behind(time_s):
                        autopilot.answer()
                    else:
                        behind.remove(autopilot)
            if has_gone_on:
                last_sign_s = time.monotonic()
                continue
            for autopilot in behind:
                autopilot.check(last_sign_s + _SILENCE_S, f"no sign of life in {_SILENCE_S:g} s of wall time")
        said = [autopilot.listen() for autopilot in self._autopilots]
        return any(said)

    def close(self) -> None:
        """Let go of them."""
        self._selector.close()
