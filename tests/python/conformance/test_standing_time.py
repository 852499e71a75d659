"""A node that sets timers for now without end gets an exception in both modes; the run does not hang."""

import re

import pytest
from perfect_channel import MODES, Case

from gradysim.protocol.errors import TimerException
from gradysim.simulator import event
from python.quiet_protocol import Quiet


class Restless(Quiet):
    """Node 0 sets its timer again at once."""

    def initialize(self) -> None:
        if self.provider.get_id() == 0:
            self.provider.schedule_timer("tick", 0.25)
        for _ in range(100):
            self.provider.schedule_timer("other", 0.25)

    def handle_timer(self, timer: str) -> None:
        if timer == "tick":
            self.provider.schedule_timer(timer, self.provider.current_time())


@pytest.mark.parametrize("mode", MODES)
def test_the_run_ends_and_names_node_timer_and_time(mode: str, monkeypatch: pytest.MonkeyPatch) -> None:
    # A million timers take seconds in prototype mode: a smaller limit gives the same message.
    monkeypatch.setattr(event, "MOST_AT_ONE_INSTANT", 1000)
    with pytest.raises(TimerException) as error:
        Case([(0.0, 0.0, 0.0), (10.0, 0.0, 0.0)]).run(mode, Restless)
    text = re.sub(r"0\.250* s", "0.25 s", str(error.value))
    assert text.startswith("node 0 ")
    assert all(part in text for part in (" 1000000 ", " 0.25 s", "'tick'"))
