"""Log lines with simulated time and node."""

import logging
from collections.abc import Callable, Sequence
from datetime import timedelta
from pathlib import Path
from typing import Any

from gradysim.simulator.node import Node

# Formatters of the simulations that log now, in the order of installation.
_installed: "list[SimulationFormatter]" = []


class _RootLevel:
    """Keeps the root logger's level low enough for all simulations that log, and restores it afterwards."""

    def __init__(self) -> None:
        self._before = logging.NOTSET
        self._set: int | None = None

    def follow(self, levels: Sequence[int]) -> None:
        """Adapt to the levels of the simulations that log now. Keep a level that other code has set."""
        root = logging.getLogger()
        if self._set is None:
            self._before = self._set = root.level
        if root.level == self._set:
            self._set = min([self._before, *levels])
            if self._set != root.level:
                root.setLevel(self._set)
        if not levels:
            self._set = None


_root_level = _RootLevel()


class SimulationFormatter(logging.Formatter):
    """Puts level, iteration, simulated time and context in front of each message.

    The prefix is made when a line is logged. An event without log lines costs two assignments.

    Several simulations may log at the same time; for example, if they are stepped in turn. A line from the
    thread that runs a simulation belongs to that simulation, and only its formatter writes it. Other lines
    are written once, by the formatter that was installed last.

    Attributes:
        thread: Identifier of the thread that runs the simulation; None while it does not run.
        iteration: Number of the current event; None outside of events: then lines get no prefix.
        context: Description of the event.
        clock: Returns the simulated time in seconds.
    """

    def __init__(self, clock: Callable[[], float] = lambda: 0.0) -> None:
        super().__init__("%(message)s")
        self.iteration: int | None = None
        self.context = ""
        self.clock = clock
        self.thread: int | None = None
        self._handlers: list[logging.Handler] = []
        self._level = logging.NOTSET

    @property
    def prefix(self) -> str:
        """Prefix of a message logged now."""
        if self.iteration is None:
            return ""
        time = timedelta(seconds=self.clock())
        return f"[it={self.iteration} time={time} | {self.context}] "

    def scope_event(self, iteration: int, context: str) -> None:
        """Set the current event."""
        self.iteration = iteration
        self.context = context

    def clear_iteration(self) -> None:
        """Leave the current event."""
        self.iteration = None
        self.context = ""

    def format(self, record: logging.LogRecord) -> str:
        """Format a log line."""
        return f"{record.levelname:<8} {self.prefix}{super().format(record)}"

    def accepts(self, record: logging.LogRecord) -> bool:
        """Return whether this formatter writes the log line; see the class."""
        if len(_installed) == 1:
            return True
        running = [formatter for formatter in _installed if formatter.thread == record.thread]
        return self is (running or _installed)[-1]

    def install(self, level: int, log_file: Path | None) -> None:
        """Write lines from `level` on to standard error, and to the file if there is one.

        Raise OSError if the file cannot be written. Then nothing is installed.
        """
        root = logging.getLogger()
        handlers: list[logging.Handler] = [logging.StreamHandler()]
        if log_file is not None:
            handlers.append(logging.FileHandler(log_file, encoding="utf-8"))
        for handler in handlers:
            handler.setFormatter(self)
            handler.setLevel(level)
            handler.addFilter(self.accepts)
            root.addHandler(handler)
        self._handlers = handlers
        self._level = level
        _installed.append(self)
        _root_level.follow([formatter._level for formatter in _installed])

    def remove(self) -> None:
        """Undo `install`; no-op if that has happened already."""
        if self not in _installed:
            return
        root = logging.getLogger()
        for handler in self._handlers:
            root.removeHandler(handler)
            handler.close()
        self._handlers = []
        _installed.remove(self)
        _root_level.follow([formatter._level for formatter in _installed])


def setup_simulation_formatter(
    debug: bool,
    log_file: Path | None,
    *,
    quiet: bool = False,
    clock: Callable[[], float] = lambda: 0.0,
) -> SimulationFormatter:
    """Start logging for one simulation, on Python's root logger. `remove` of the formatter ends it.

    The default level is INFO; with `debug` it is DEBUG, with `quiet` WARNING. Lines are also appended to
    `log_file`, if given. `clock` returns the simulated time in seconds.
    """
    level = logging.WARNING if quiet else logging.DEBUG if debug else logging.INFO
    formatter = SimulationFormatter(clock)
    formatter.install(level, log_file)
    return formatter


class EventContext(str):
    """Description of an event for log lines: "Hello 3 handle_timer".

    Attributes:
        node_id: Id of the node.
    """

    node_id: int


def context_of(node: Node[Any], callback: str) -> EventContext:
    """Return the context of the events that call a node."""
    context = EventContext(f"{label_node(node)} {callback}")
    context.node_id = node.id
    return context


def label_node(node: Node[Any]) -> str:
    """Return a node's name for log lines: "ProtocolClass id"; "Node id" if it has no protocol."""
    protocol = getattr(getattr(node, "protocol_encapsulator", None), "protocol", None)
    return f"{'Node' if protocol is None else type(protocol).__name__} {node.id}"


def format_table(headers: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Lay out a table as text. Each column is as wide as its longest cell."""
    lines = [headers, *rows]
    widths = [max(len(str(line[column])) for line in lines) for column in range(len(headers))]
    texts = [
        "  ".join(str(cell).ljust(width) for cell, width in zip(line, widths, strict=True)) for line in lines
    ]
    rule = "  ".join("-" * width for width in widths)
    return "\n".join(text.rstrip() for text in (texts[0], rule, *texts[1:]))
