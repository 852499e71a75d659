"""Exceptions of a protocol's commands, the same in both modes.

They can also be imported from the modules of prototype mode's handlers, as in gradysim 0.8.
"""


class CommunicationException(Exception):  # noqa: N818 (the published name)
    """A message cannot be sent: unknown destination, not a str, too long for the network, ..."""


class TimerException(Exception):  # noqa: N818 (the published name)
    """A timer cannot be set or canceled: it is in the past, its name is not a str, ..."""


class MasslessMobilityException(Exception):  # noqa: N818 (the published name)
    """A mobility command cannot be carried out: invalid target, negative speed, stationary node, ..."""


class NativeProtocolError(RuntimeError):
    """A native protocol failed. Its note says where; no code of the user is involved."""
