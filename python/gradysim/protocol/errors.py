"""What a protocol's command raises when it cannot be carried out: the same in every mode.

The published package has these names in the modules of prototype mode's handlers, where they still can be
imported from.
"""


class CommunicationException(Exception):  # noqa: N818 (the published name)
    """A message cannot be sent: an unknown destination, no text, longer than the network takes, ..."""


class TimerException(Exception):  # noqa: N818 (the published name)
    """A timer cannot be set or cancelled: it is in the past, its name is not a text, ..."""


class MasslessMobilityException(Exception):  # noqa: N818 (the published name)
    """A mobility command cannot be carried out: not a place, a negative speed, a node that stands, ..."""


class NativeProtocolError(RuntimeError):
    """A protocol of the engine got something wrong. No code of the user led to it: its note tells all."""
