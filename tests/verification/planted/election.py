"""All or none: candidates claim to be the leader at once, and all others should hear the same claims."""

from node import Node


class Candidate(Node):
    """Claims to be the leader each second."""

    def initialize(self) -> None:
        self.set_timer_in("claim", 1)

    def handle_timer(self, timer: str) -> None:
        self.broadcast(str(self.provider.get_id()))
        self.set_timer_in("claim", 1)


class Follower(Node):
    """Follows the candidate with the lowest id that it heard; node 0 if it heard none."""

    def initialize(self) -> None:
        self.heard: set[int] = set()
        self.provider.tracked_variables["wrong"] = 0
        self.set_timer_in("choose", 1.5)

    def handle_packet(self, message: str) -> None:
        self.heard.add(int(message))

    def handle_timer(self, timer: str) -> None:
        if min(self.heard, default=0) != 0:
            self.count("wrong")
        self.heard.clear()
        self.set_timer_in("choose", 1)
