"""Keys of prototype mode's medium."""

from gradysim.scenario.keys.key import Key
from gradysim.scenario.keys.shapes import Below
from gradysim.scenario.parameter_types import number, quantity

_own = Below("communicationMedium", "communication_medium")

COMMUNICATION_MEDIUM_KEYS: tuple[Key, ...] = (
    _own(
        "transmissionRange",
        "transmission_range_m",
        quantity("m", at_least=0),
        "Prototype mode: distance up to which a message arrives. Radios of integrated mode reach 786 m by"
        " default; wlan[*].radio.transmitter.communicationRange = 60m gives them the same range",
    ),
    _own("delay", "delay_s", quantity("s", at_least=0), "Prototype mode: time from sending to arrival"),
    _own(
        "failureRate",
        "failure_rate",
        number(at_least=0, at_most=1),
        "Prototype mode: part of the messages that is lost, 0 to 1",
    ),
)
