"""A provider for the consensus alone."""


class BareProvider:
    """Has only the methods that the plugin uses."""

    def __init__(self, node_id=3):
        self.node_id = node_id
        self.sent = []
        self.timers = {}

    def send_communication_command(self, command):
        self.sent.append(command)

    def schedule_timer(self, timer, timestamp):
        self.timers[timer] = timestamp

    def cancel_timer(self, timer):
        self.timers.pop(timer, None)

    def current_time(self):
        return 7.0

    def get_id(self):
        return self.node_id
