"""Handler that shows a simulation while it runs."""

import logging
import time
import weakref
import webbrowser
from typing import Any

from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.handler.visualization.messages import (
    CommandQueue,
    VisualizationConfiguration,
    greeting,
    snapshot,
)
from gradysim.simulator.handler.visualization.server import AddressInUse, VisualizationServer
from gradysim.simulator.node import Node
from gradysim.simulator.validation import checked_configuration

_logger = logging.getLogger(__name__)


class VisualizationHandler(INodeHandler):
    """Shows a running simulation in web browsers. Viewers may pause it.

    The page is at http://HOST:PORT/. The public viewer of gradysim can connect, too. The simulation ends when
    only the events of this handler are left.

    Attributes:
        command_queue: Commands to the viewers, made by VisualizationController. They wait here for the first
            viewer.
        nodes: Shown nodes, by id.
    """

    def __init__(self, configuration: VisualizationConfiguration | None = None) -> None:
        """Without a configuration the defaults of `VisualizationConfiguration` hold."""
        self._configuration = checked_configuration(configuration, VisualizationConfiguration)
        self.command_queue = CommandQueue()
        self._event_loop: EventLoop | None = None
        self.nodes: dict[int, Node[Any]] = {}
        self._server: VisualizationServer | None = None
        self._guard: weakref.finalize[[], VisualizationHandler] | None = None
        self._start_wall_s = 0.0

    @staticmethod
    def get_label() -> str:
        """Return "visualization"."""
        return "visualization"

    @property
    def port(self) -> int | None:
        """Port for viewers; None while no simulation runs."""
        return None if self._server is None else self._server.port

    def inject(self, event_loop: EventLoop) -> None:
        """Take the event loop of a new simulation, and forget the state of an earlier one."""
        self._stop()
        if self._event_loop is not None:
            self.command_queue = CommandQueue()
        self._event_loop = event_loop
        self.nodes = {}

    def register_node(self, node: Node[Any]) -> None:
        """Add a node to show."""
        self.nodes[node.id] = node

    def initialize(self) -> None:
        """Start to serve viewers. If the address is in use, log a warning and run without viewers."""
        self.paused_s = 0.0
        self._start_wall_s = time.monotonic()
        welcome = greeting(self._configuration, list(self.nodes.values()))
        server = VisualizationServer(self._configuration, welcome, self.command_queue)
        try:
            server.start()
        except AddressInUse as error:
            # Usually another simulation uses the port. Several at once must not end each other.
            _logger.warning(
                "%s; the simulation goes on without viewers: expected a `port` that no other simulation has",
                error,
            )
            return
        # A simulation that is dropped before its end must not leave a thread behind.
        self._guard = weakref.finalize(self, server.stop)
        self._server = server
        self._publish(server)
        self._schedule_collection()
        _logger.info("The simulation is shown at %s", server.address)
        if self._configuration.open_browser:
            webbrowser.open(server.address)

    def finalize(self) -> None:
        """Show the final state and stop the server."""
        if self._server is not None:
            self._publish(self._server)
        self._stop()

    def _schedule_collection(self) -> None:
        assert self._event_loop is not None
        self._event_loop.schedule_event(
            self._event_loop.current_time + self._configuration.information_collection_interval,
            self._collect,
            "Visualization",
        )

    def _collect(self) -> None:
        server, event_loop = self._server, self._event_loop
        if server is None or event_loop is None:
            return
        is_paused = server.is_paused
        if server.wants_snapshot or is_paused:
            self._publish(server)
        if len(event_loop) > 0:
            self._schedule_collection()
        if is_paused:
            paused_at = time.monotonic()
            try:
                server.wait_while_paused()
            finally:
                self.paused_s += time.monotonic() - paused_at

    def _publish(self, server: VisualizationServer) -> None:
        assert self._event_loop is not None
        real_s = time.monotonic() - self._start_wall_s
        server.publish(snapshot(list(self.nodes.values()), self._event_loop.current_time, real_s))

    def _stop(self) -> None:
        self._server = None
        if self._guard is not None:
            self._guard()
            self._guard = None
