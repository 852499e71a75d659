"""`gradysim run --memory`: a memory limit for each run."""

import contextlib
import sys
from collections.abc import Iterator

from gradysim.cli.options import option_value

_LARGEST = 2**62


def checked_limit(text: str | None) -> int | None:
    """Return a limit in bytes; None for no limit. Raises ConfigError, which names the option."""
    from gradysim.scenario.errors import ConfigError
    from gradysim.scenario.schema.parameter_types import whole_bytes

    if text is None:
        return None
    limit_bytes = int(option_value("--memory", text, whole_bytes(at_least=1, at_most=_LARGEST)))
    if sys.platform != "linux":
        raise ConfigError(f"--memory {text}: only Linux can limit the memory of a process")
    return limit_bytes


@contextlib.contextmanager
def limited(limit_bytes: int | None) -> Iterator[None]:
    """Limit the memory of this process inside the block: Python raises MemoryError.

    The limit counts memory that the process allocates, without libraries and shared memory. It ends with the
    block, so that results can be written.
    """
    if limit_bytes is None or sys.platform != "linux":
        yield
        return
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_DATA)
    ceiling = limit_bytes if hard == resource.RLIM_INFINITY else min(limit_bytes, hard)
    resource.setrlimit(resource.RLIMIT_DATA, (ceiling, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_DATA, (soft, hard))
