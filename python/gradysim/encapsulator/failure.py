"""Says where in a run the exception of a protocol happened."""


def add_protocol_note(
    exception: BaseException, *, node_id: int, protocol: type, time_s: float, callback: str
) -> None:
    """Note node, simulated time and callback on the exception of a protocol; its traceback stays as it is.

    So is it on a KeyboardInterrupt: it tells which callback does not return.

    Args:
        exception: What the protocol raised.
        node_id: Id of the protocol's node.
        protocol: Its class.
        time_s: Simulated time in seconds.
        callback: Name of the protocol's method that was running.
    """
    label = f"{protocol.__name__} {node_id}"
    exception.add_note(f"in {callback} of node {node_id} ({label}) at {time_s:.12g} s of simulated time")
