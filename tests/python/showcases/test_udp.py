"""UdpBasicApp: when it sends, and to whom."""

import pytest

from python.showcases.conftest import Ran

APPS = (
    '*.hosts[*].protocol.class = "gradysim.showcases:UdpBasicApp"\n*.numHosts = 3\n'
    '*.hosts[0].protocol.destinations = "1 2"\n'
)


@pytest.mark.parametrize(
    ("lines", "sent"),
    [
        ("", 11),
        ("*.hosts[0].protocol.send_interval = 2s", 6),
        ("*.hosts[0].protocol.start_time = 4.5s", 6),
        ("*.hosts[0].protocol.start_time = -3s", 11),
        ("*.hosts[0].protocol.stop_time = 4s", 4),
    ],
)
def test_when_it_sends(ran: Ran, lines: str, sent: int) -> None:
    nodes = ran(APPS + lines, limit_s=10.2)
    counts = [node.tracked_variables for node in nodes.values()]
    assert [count["sent"] for count in counts] == [sent, 0, 0]
    assert sum(count["received"] for count in counts) == sent
    assert all(count["received"] for count in counts[1:])


def test_what_is_not_an_interval(ran: Ran) -> None:
    with pytest.raises(ValueError, match="send_interval is 0"):
        ran(f"{APPS}*.hosts[0].protocol.send_interval = 0s")
