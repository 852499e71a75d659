"""Exceptions of a protocol's commands, the same in both modes, and the note on those of its callbacks.

The exceptions can also be imported from the modules of prototype mode's handlers, as in gradysim 0.8.
"""


class CommunicationException(Exception):  # noqa: N818 (the published name)
    """A message cannot be sent: unknown destination, not a str, too long for the network, ..."""


class TimerException(Exception):  # noqa: N818 (the published name)
    """A timer cannot be set or canceled: it is in the past, its name is not a str, ..."""


class MasslessMobilityException(Exception):  # noqa: N818 (the published name)
    """A mobility command cannot be carried out: invalid target, negative speed, stationary node, ..."""


class NativeProtocolError(RuntimeError):
    """A native protocol failed. Its note says where; no code of the user is involved."""


def add_protocol_note(
    exception: BaseException, *, node_id: int, protocol: type, time_s: float, callback: str
) -> None:
    """Add a note with node, simulated time (s) and callback to an exception that a protocol has raised.

    A KeyboardInterrupt gets the note, too: it names a callback that does not return. For a constructor that
    uses `self.provider`, the note says what to do instead.

    In prototype mode `PythonEncapsulator` calls this. The engine (`PythonProtocol::check`) calls it by
    `NetsimEncapsulator`. For native protocols `integrated/run.py` does.
    """
    label = f"{protocol.__name__} {node_id}"
    note = f"in {callback} of node {node_id} ({label}) at {time_s:.12g} s of simulated time"
    if callback == "__init__" and isinstance(exception, AttributeError) and exception.name == "provider":
        note += "; the constructor has no provider yet: use it in `initialize`"
    exception.add_note(note)
