"""Log lines that say when in the simulation, and to whom, something happened."""

import logging
from collections.abc import Callable, Sequence
from datetime import timedelta
from pathlib import Path
from typing import Any

from gradysim.simulator.node import Node

# Formatters of the simulations that log now, the latest last.
_installed: "list[SimulationFormatter]" = []


class _RootLevel:
    """Keeps the root logger's level low enough for all simulations that log; puts it back when none does."""

    def __init__(self) -> None:
        self._before = logging.NOTSET
        self._set: int | None = None

    def follow(self, levels: Sequence[int]) -> None:
        """Adapt to the levels of the simulations that log now; a level that somebody else has set stays."""
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

    The text is made when a line is logged; an event that logs nothing costs two assignments.

    Several simulations may log at a time, as when they are stepped in turn: a line from the thread in which
    one of them is running now is that simulation's and is written by no other. Any other line is written
    once, by the one that was set up last.

    Attributes:
        thread: Identifier of the thread in which the simulation is running now; None while it is not.
        iteration: Number of the event under way; None when there is none, and nothing is put in front.
        context: What the event is about.
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
        """What is put in front of a message now."""
        if self.iteration is None:
            return ""
        time = timedelta(seconds=self.clock())
        return f"[it={self.iteration} time={time} | {self.context}] "

    def scope_event(self, iteration: int, context: str) -> None:
        """Say which event is under way."""
        self.iteration = iteration
        self.context = context

    def clear_iteration(self) -> None:
        """Say that no event is under way."""
        self.iteration = None
        self.context = ""

    def format(self, record: logging.LogRecord) -> str:
        """Format a line of the log."""
        return f"{record.levelname:<8} {self.prefix}{super().format(record)}"

    def accepts(self, record: logging.LogRecord) -> bool:
        """Whether a line of the log is this simulation's, as said above."""
        if len(_installed) == 1:
            return True
        running = [formatter for formatter in _installed if formatter.thread == record.thread]
        return self is (running or _installed)[-1]

    def install(self, level: int, log_file: Path | None) -> None:
        """Write what is logged from `level` on to standard error, and to the file if there is one.

        A file that cannot be written is an OSError, and nothing is installed then.
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

    It logs from INFO on, with `debug` from DEBUG on, and with `quiet` from WARNING on, also to the end of a
    file if one is given. `clock` returns the simulated time in seconds.
    """
    level = logging.WARNING if quiet else logging.DEBUG if debug else logging.INFO
    formatter = SimulationFormatter(clock)
    formatter.install(level, log_file)
    return formatter


class EventContext(str):
    """What an event is about, for log lines: "Hello 3 handle_timer".

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
    """Return a node's name for people: "ProtocolClass id"; "Node id" if it has no protocol."""
    protocol = getattr(getattr(node, "protocol_encapsulator", None), "protocol", None)
    return f"{'Node' if protocol is None else type(protocol).__name__} {node.id}"


def format_table(headers: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Lay out a table as text, each column as wide as its longest cell."""
    lines = [headers, *rows]
    widths = [max(len(str(line[column])) for line in lines) for column in range(len(headers))]
    texts = [
        "  ".join(str(cell).ljust(width) for cell, width in zip(line, widths, strict=True)) for line in lines
    ]
    rule = "  ".join("-" * width for width in widths)
    return "\n".join(text.rstrip() for text in (texts[0], rule, *texts[1:]))
