"""Which instance numbers of ArduPilot's SITL are free on this machine."""

import random
import socket
from contextlib import ExitStack

from gradysim.sitl.error import SitlError

_FIRST_PORTS = ((socket.SOCK_DGRAM, 5501), (socket.SOCK_DGRAM, 9003), (socket.SOCK_STREAM, 5760))
"""What instance 0 may open: remote control and external physics (UDP), the first serial port (TCP)."""

_PORTS_PER_INSTANCE = 10
_INSTANCES = 256
"""ArduCopter 4.1 and older take the rest of a larger number."""

_TRIES = 100


def free_instance(taken: set[int]) -> int:
    """Return a number, not in `taken`, whose ports nobody has opened.

    It is drawn at random, from the system and not from the simulation's seed, so that simulations that start
    at the same time seldom meet.

    Raises:
        SitlError: None was found.
    """
    lottery = random.SystemRandom()
    for _ in range(_TRIES):
        instance = lottery.randrange(_INSTANCES)
        if instance not in taken and _is_free(instance):
            return instance
    raise SitlError(f"no free ports for another autopilot, after {_TRIES} tries")


def _is_free(instance: int) -> bool:
    with ExitStack() as stack:
        try:
            for kind, first in _FIRST_PORTS:
                probe = stack.enter_context(socket.socket(socket.AF_INET, kind))
                probe.bind(("0.0.0.0", first + _PORTS_PER_INSTANCE * instance))
        except OSError:
            return False
    return True
