"""Commands to the viewers that wait to be sent."""

from queue import Queue
from typing import Any

Command = dict[str, Any]
"""{"command": name, "payload": {...}}, of plain values; colours are tuples."""

# So many may wait before those that later ones make void are dropped.
_LENGTH_LIMIT = 10_000


class CommandQueue(Queue[Command]):
    """First in, first out; filled by the simulation and emptied by the server's thread.

    As long as no viewer is there the commands wait, and a simulation may go on for hours: when they become
    many, only the last one of each kind and node stays.
    """

    def __init__(self) -> None:
        super().__init__()
        self._limit = _LENGTH_LIMIT

    def _put(self, item: Command) -> None:
        super()._put(item)
        if len(self.queue) > self._limit:
            last = {
                (command["command"], command["payload"].get("node_id")): command for command in self.queue
            }
            kept = {id(command) for command in last.values()}
            commands = [command for command in self.queue if id(command) in kept]
            self.queue.clear()
            self.queue.extend(commands)
            self._limit = max(_LENGTH_LIMIT, 2 * len(commands))
