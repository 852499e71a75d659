"""Says where in a run the exception of a protocol happened."""


def add_protocol_note(
    exception: BaseException, *, node_id: int, protocol: type, time_s: float, callback: str
) -> None:
    """Note node, simulated time and callback on the exception of a protocol; its traceback stays as it is.

    Ctrl-C (KeyboardInterrupt) is nobody's failure and gets no note. All others get one, also SystemExit.

    Args:
        exception: What the protocol raised.
        node_id: Id of the protocol's node.
        protocol: Its class.
        time_s: Simulated time in seconds.
        callback: Name of the protocol's method that was running.
    """
    if not isinstance(exception, KeyboardInterrupt):
        label = f"{protocol.__name__} {node_id}"
        exception.add_note(f"in {callback} of node {node_id} ({label}) at {time_s:.12g} s of simulated time")
