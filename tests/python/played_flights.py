"""Flights without autopilots, which log their calls."""

from gradysim.sitl.flight_orders import give_order


class PlayedPilot:
    """Logs its commands."""

    def __init__(self):
        self.orders = []

    def go_to(self, target):
        self.orders.append(target)


class PlayedFlights:
    """Replaces `Flights`: only node 0, whose x is the time up to which it has flown."""

    ids = frozenset({0})

    def __init__(self):
        self.diary = []
        self.time_s = 0.0
        self.pilots = {0: PlayedPilot()}

    def begin(self):
        self.diary.append("begin")

    def advance_to(self, time_s):
        self.diary.append(time_s)
        self.time_s = time_s

    def position(self, node_id):
        assert node_id == 0
        return (self.time_s, 0.0, 5.0)

    def give_order(self, command, node_id):
        give_order(command, node_id, (0, 0, 0), self.pilots[node_id])

    def close(self):
        self.diary.append("close")
