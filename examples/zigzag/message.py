"""Messages of ZigZag and their encoding: short JSON strings.

    UAV or ground station             UAV (or ground station)
       heartbeat (broadcast)  ------>
                              <------  PairRequest
       PairConfirmation       ------>

Sensors answer the heartbeat of a UAV with `SensorData`.
"""

import json
from dataclasses import dataclass


@dataclass(frozen=True)
class UavHeartbeat:
    """Broadcast by a UAV: I am here.

    Attributes:
        sender: Id of the UAV.
        homeward: True while it flies towards the ground station.
        available: False while it ignores the other UAVs and the ground station.
    """

    sender: int
    homeward: bool
    available: bool


@dataclass(frozen=True)
class GroundHeartbeat:
    """Broadcast by the ground station: I am here, and I take everything."""

    sender: int


@dataclass(frozen=True)
class SensorData:
    """One reading of a sensor. Its value does not matter here: the receiver only counts it."""

    sender: int


@dataclass(frozen=True)
class PairRequest:
    """Answer to a heartbeat: a request to exchange data and fly apart.

    Attributes:
        sender: Id of the requesting node.
        carrier: Id of the node that gets all data.
        given: Total number of readings handed to the receiver so far (see `custody.py`).
    """

    sender: int
    carrier: int
    given: int


@dataclass(frozen=True)
class PairConfirmation:
    """Answer to a `PairRequest`: the exchange is done on this side. Attributes as there."""

    sender: int
    carrier: int
    given: int


Message = UavHeartbeat | GroundHeartbeat | SensorData | PairRequest | PairConfirmation

_TYPES: dict[str, type[Message]] = {
    cls.__name__: cls for cls in (UavHeartbeat, GroundHeartbeat, SensorData, PairRequest, PairConfirmation)
}

_to_json = json.JSONEncoder(separators=(",", ":")).encode  # without spaces: every byte takes airtime


def encode(message: Message) -> str:
    """Return the string to send, e.g. `{"type":"SensorData","sender":4}`."""
    return _to_json({"type": type(message).__name__, **vars(message)})


def decode(text: str) -> Message:
    """Return the message encoded in `text`. Raises ValueError for any other string."""
    try:
        fields = json.loads(text)
        return _TYPES[fields.pop("type")](**fields)
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise ValueError(f"not a message of ZigZag: {text!r}") from error
