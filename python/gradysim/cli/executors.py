"""Executors of `gradysim run --executor`, other than processes of this machine."""

import contextlib
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Any

from gradysim.cli.options import RunOptions

_CONNECT_S = 30
"""Wall time in seconds to wait for a scheduler."""


@dataclass(frozen=True)
class Workers:
    """An executor, and a function that returns how many tasks it carries out at the same time."""

    executor: Executor
    count: Callable[[], int]


def check_executor(options: RunOptions) -> None:
    """Raise ConfigError if --executor and --scheduler do not fit, or if Dask is not installed."""
    from gradysim.scenario.errors import ConfigError

    if options.executor != "dask":
        if options.scheduler is not None:
            raise ConfigError(f"--scheduler {options.scheduler}: expected --executor dask, too")
        return
    if options.scheduler is None:
        raise ConfigError("--executor dask: expected the address of its scheduler, --scheduler HOST:PORT")
    try:
        import distributed  # noqa: F401
    except ImportError as error:
        raise ConfigError(
            f"--executor dask: {error}; expected the package distributed: pip install distributed"
        ) from error


@contextlib.contextmanager
def workers_of(options: RunOptions) -> Iterator[Workers | None]:
    """Connect to the workers of --executor; None for processes of this machine. Raises ConfigError."""
    if options.executor != "dask" or options.scheduler is None:
        yield None
        return
    from distributed import Client

    from gradysim.scenario.errors import ConfigError

    try:
        client: Any = Client(options.scheduler, timeout=_CONNECT_S, set_as_default=False)  # type: ignore[no-untyped-call]
    except (OSError, ValueError) as error:
        raise ConfigError(
            f"--scheduler {options.scheduler}: {error}; expected the address of a Dask scheduler"
        ) from error
    with client:
        yield Workers(client.get_executor(pure=False), lambda: sum(client.nthreads().values()))
