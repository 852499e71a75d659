"""What handlers see of the engine's nodes."""

import pytest

from gradysim.integrated.run import IntegratedRun, run
from python.integrated.watching import Watching


def test_nodes_have_id_protocol_seed_and_live_position(make_scenario):
    class Looking(Watching):
        def initialize(self):
            self.seen = []
            self.event_loop.schedule_event(1.0, lambda: self.seen.append(self.nodes[0].position))

    handler = Looking()
    scenario = make_scenario(
        "class Tested(Quiet):\n"
        "    def initialize(self):\n"
        "        self.provider.send_mobility_command(GotoCoordsMobilityCommand(0, 0, 100))",
        "seed-set = 7",
    )
    run(scenario, handlers=[handler])
    assert [node.id for node in handler.nodes] == [0, 1]
    assert [node.seed for node in handler.nodes] == [7, 7]
    assert [type(node.protocol_encapsulator.protocol).__name__ for node in handler.nodes] == ["Tested"] * 2
    assert handler.seen == [pytest.approx((0, 0, 10))]
    assert handler.nodes[0].position == pytest.approx((0, 0, 20.5))


def test_nodes_cannot_be_moved(make_scenario):
    handler = Watching()
    IntegratedRun(make_scenario(), handlers=[handler])
    with pytest.raises(AttributeError, match=r"node 1 cannot be set .* prototype mode only; .* commands"):
        handler.nodes[1].position = (0, 0, 0)
