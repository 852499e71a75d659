"""The messages of ZigZag, and their form on the air: short JSON texts.

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
    """One reading of a sensor. What was read does not matter here: whoever receives it counts it."""

    sender: int


@dataclass(frozen=True)
class PairRequest:
    """The answer to a heartbeat: let us exchange our data and fly apart.

    Attributes:
        sender: Id of the node that asks.
        carrier: Id of the one of the two that gets all data.
        given: What the sender has handed to the receiver so far, in all (see `custody.py`).
    """

    sender: int
    carrier: int
    given: int


@dataclass(frozen=True)
class PairConfirmation:
    """The answer to a `PairRequest`: agreed, and done on my side. Attributes as there."""

    sender: int
    carrier: int
    given: int


Message = UavHeartbeat | GroundHeartbeat | SensorData | PairRequest | PairConfirmation

_TYPES: dict[str, type[Message]] = {
    cls.__name__: cls for cls in (UavHeartbeat, GroundHeartbeat, SensorData, PairRequest, PairConfirmation)
}

_to_json = json.JSONEncoder(separators=(",", ":")).encode  # without blanks: every byte takes time on the air


def encode(message: Message) -> str:
    """The text that is sent, e.g. `{"type":"SensorData","sender":4}`."""
    return _to_json({"type": type(message).__name__, **vars(message)})


def decode(text: str) -> Message:
    """The message that `encode` made this text of. Raises ValueError for any other text."""
    try:
        fields = json.loads(text)
        return _TYPES[fields.pop("type")](**fields)
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise ValueError(f"not a message of ZigZag: {text!r}") from error
