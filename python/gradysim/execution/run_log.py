"""Log lines of a run, with simulated time and node; the same in both modes."""

import logging
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

from gradysim.replay.tables import EVENT_KINDS
from gradysim.replay.trace import name_width, text_line
from gradysim.scenario.node_spec import NodeSpec

_OWN = "gradysim."
"""Loggers of this package. Their lines appear from WARNING on; at level DEBUG, all of them."""

RecordEvent = Callable[[int, int, str], None]
"""Records an event of a replay: id of the node, kind of `EVENT_KINDS` by number, text."""


class RunLog(logging.Handler):
    """Writes log lines of a run to standard error.

    If logging has been configured, its handlers and levels apply. In both cases a replay gets the lines of
    nodes.
    """

    def __init__(self, level: int, nodes: Sequence[NodeSpec]) -> None:
        """Log from `level` on, one of the levels of `logging`. Nodes come in the order of their ids."""
        super().__init__(level)
        self._nodes = nodes
        self._width = 0
        self._thread: int | None = None

    @contextmanager
    def in_use(
        self,
        now: Callable[[], float],
        active_node: Callable[[], int | None],
        record_event: RecordEvent | None = None,
    ) -> Iterator[None]:
        """Write the lines that are logged inside the block.

        Args:
            now: Returns the simulated time in seconds.
            active_node: Returns the id of the node whose protocol runs, None outside of callbacks.
            record_event: Records the lines of nodes.
        """
        self._now, self._active_node, self._record_event = now, active_node, record_event
        self._thread = threading.get_ident()
        root = logging.getLogger()
        before = own = root.level
        if all(isinstance(handler, RunLog) for handler in root.handlers):
            own = min(before, self.level)
        if own != before:  # all loggers look up their levels again
            root.setLevel(own)
        root.addHandler(self)
        try:
            yield
        finally:
            root.removeHandler(self)
            if own != before and root.level == own:
                root.setLevel(before)
            del self._now, self._active_node, self._record_event  # which refer to the run

    def emit(self, record: logging.LogRecord) -> None:
        """Write a line, or several if its message has several."""
        if not self._is_mine(record):
            return
        try:
            node = self._active_node() if record.thread == self._thread else None
            text = self.format(record)
            kind = _kind_of(record.levelno)
            if node is not None and self._record_event is not None:
                self._record_event(node, EVENT_KINDS.index(kind), text)
            if self._is_shown(record):
                self._write(node, kind, text)
        except Exception:
            self.handleError(record)

    def _is_mine(self, record: logging.LogRecord) -> bool:
        """Return whether no other run, of another thread or inside this one, logged it."""
        runs = [handler for handler in logging.getLogger().handlers if isinstance(handler, RunLog)]
        return ([run for run in runs if run._thread == record.thread] or runs)[-1] is self

    def _is_shown(self, record: logging.LogRecord) -> bool:
        is_own = record.name.startswith(_OWN) and self.level > logging.DEBUG
        return not (is_own and record.levelno < logging.WARNING) and not _has_other_handler(record)

    def _write(self, node: int | None, kind: str, text: str) -> None:
        self._width = self._width or name_width(node.name for node in self._nodes)
        name = "-" if node is None else self._nodes[node].name
        lines = [text_line(self._now(), name, kind, line, self._width) for line in text.splitlines() or [""]]
        print("\n".join(lines), file=sys.stderr)


def _kind_of(level: int) -> str:
    for kind in ("error", "warning", "info"):
        if level >= getattr(logging, kind.upper()):
            return kind
    return "debug"


def _has_other_handler(record: logging.LogRecord) -> bool:
    """Return whether a handler of the user shows it. A file does not show it."""
    logger: logging.Logger | None = logging.getLogger(record.name)
    while logger is not None:
        for handler in logger.handlers:
            hides = isinstance(handler, RunLog | logging.NullHandler | logging.FileHandler)
            if not hides and record.levelno >= handler.level:
                return True
        logger = logger.parent if logger.propagate else None
    return False
