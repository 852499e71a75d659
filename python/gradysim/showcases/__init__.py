"""Protocols of GrADyS' OMNeT++ project, and UdpBasicApp of INET, for files that `gradysim import` translates.

They have the names that they have there, and their parameters in Python's spelling: `timeout_duration` is
`timeoutDuration` there. Missions are part of the protocols here, and of the mobility there.
"""

from gradysim.showcases.communication import CommunicationProtocolBase
from gradysim.showcases.dadca import DadcaProtocol, DadcaProtocolGround, DadcaProtocolSensor
from gradysim.showcases.simple import SimpleDroneProtocol, SimpleGroundProtocol, SimpleSensorProtocol
from gradysim.showcases.udp import UdpBasicApp
from gradysim.showcases.zigzag import ZigzagProtocol, ZigzagProtocolSensor

__all__ = [
    "CommunicationProtocolBase",
    "DadcaProtocol",
    "DadcaProtocolGround",
    "DadcaProtocolSensor",
    "SimpleDroneProtocol",
    "SimpleGroundProtocol",
    "SimpleSensorProtocol",
    "UdpBasicApp",
    "ZigzagProtocol",
    "ZigzagProtocolSensor",
]
