"""Workers of `gradysim run --executor dask`: those of a Dask cluster."""

import contextlib
import logging
import sys
import time
from collections.abc import Iterable, Iterator
from typing import Any

from gradysim.cli.executor import Batch, WorkersLostError
from gradysim.cli.run_task import Command
from gradysim.cli.workers import ExecutorWorkers, press

ANSWERS_WITHIN_S = 30.0
"""Wall time in seconds until a scheduler that does not answer is lost."""

_CLOSES_WITHIN_S = 3.0
"""Wall time in seconds until a connection that does not close is given up."""

WITHOUT_WORKERS_S = 30.0
"""Wall time in seconds until a cluster without workers is lost."""


class _DaskWorkers(ExecutorWorkers):
    """The workers of a Dask cluster, of which some may come and go."""

    def __init__(self, client: Any, name: str, command: Command) -> None:
        """`name` is that of the cluster, for messages."""
        super().__init__(client.get_executor(pure=False), 0, command)
        self._client = client
        self._name = name
        self._seen_s = time.monotonic()
        self._is_lost = False

    def count(self) -> int:
        try:
            threads = self._client.sync(self._client.scheduler.ncores, callback_timeout=ANSWERS_WITHIN_S)
        except OSError as error:
            raise self.lost() from error
        now_s = time.monotonic()
        if threads:
            self._seen_s = now_s
        elif now_s - self._seen_s > WITHOUT_WORKERS_S:
            raise WorkersLostError(
                f"{self._name}: the scheduler has had no worker for {WITHOUT_WORKERS_S:g} s"
            )
        return sum(threads.values())

    def stop(self, batches: Iterable[Batch], presses: int) -> list[Batch]:
        self.press(presses)
        return []  # Dask cancels also what a worker goes on to compute

    def lost(self) -> WorkersLostError:
        self._is_lost = True
        return WorkersLostError(f"{self._name}: the scheduler does not answer any more")

    def press(self, presses: int) -> None:
        async def call() -> None:  # `Client.run` outside the event loop has no time limit
            await self._client.run(press, self._command.id, presses, on_error="ignore")

        if not self._is_lost:
            with contextlib.suppress(OSError):  # `count` reports it
                self._client.sync(call, callback_timeout=ANSWERS_WITHIN_S)

    def close(self) -> None:
        """Disconnect, also from a scheduler that does not answer."""
        with contextlib.suppress(OSError):
            self._client.close(timeout=_CLOSES_WITHIN_S)


@contextlib.contextmanager
def dask_workers(command: Command) -> Iterator[ExecutorWorkers]:
    """Connect to the workers of --executor dask. Raises ConfigError.

    Without --scheduler, they are threads of this process. Each batch has a process, which ends with this one.
    """
    from gradysim.scenario.errors import ConfigError

    try:
        import distributed
        from dask import config
    except ImportError as error:
        raise ConfigError(
            f"--executor dask: {error}; expected the package distributed: pip install distributed"
            " (the extra `dask` of gradysim)"
        ) from error
    dask: Any = distributed  # its classes are not typed
    options = command.options
    for logger in ("distributed", "distributed.client"):  # the command reports a lost cluster
        logging.getLogger(logger).setLevel(logging.CRITICAL)
    with contextlib.ExitStack() as connection:
        where = options.scheduler
        name = f"--scheduler {where}"
        if where is None:
            name = "--executor dask"
            # Its profiler takes a tenth of a core, and nobody could read what it finds.
            connection.enter_context(config.set({"distributed.worker.profile.enabled": False}))
            where = connection.enter_context(
                dask.LocalCluster(
                    n_workers=options.jobs,
                    threads_per_worker=1,
                    processes=False,
                    memory_limit=0,
                    dashboard_address=None,
                    # By default, they listen at all addresses, and the scheduler warns if port 8787 is taken.
                    scheduler_kwargs={"dashboard_address": "127.0.0.1:0"},
                    worker_dashboard_address="127.0.0.1:0",
                )
            )
            workers = f"{options.jobs} worker{'s' * (options.jobs > 1)}"
            print(f"{name}: {workers} on this machine, as no --scheduler is given", file=sys.stderr)
        try:
            client = dask.Client(where, timeout=ANSWERS_WITHIN_S, set_as_default=False)
        except (OSError, ValueError) as error:
            raise ConfigError(f"{name}: {error}; expected the address of a Dask scheduler") from error
        yield connection.enter_context(contextlib.closing(_DaskWorkers(client, name, command)))
