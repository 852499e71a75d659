"""What lines of OMNeT++ become here: renamed keys and values, and the reasons for those left out.

Paths are below a node or below the network, as in `gradysim.scenario.keys`. The facts are those of the NED
files of INET 4.5 and of GrADyS' C++ project.
"""

import re
from collections.abc import Mapping
from typing import Final

# ---- nodes and networks, for NED files ---------------------------------------------------------------------

NODE_TYPES: Final[Mapping[str, Mapping[str, str]]] = {
    "AdhocHost": {},
    "WirelessHost": {},
    "ManetRouter": {},
    "AccessPoint": {},
    "StandardHost": {},
    "MobileNode": {},
    "MobileNodeMam": {},
    "MobileSensorNode": {},
    "GroundStation": {},
    "SensorNode": {"wlan[*].typename": '"Ieee802154NarrowbandInterface"'},
}
"""{type of a submodule that is a node: {path: its default, where it is not that of this simulator}}."""

DEFAULT_MOBILITY = "StationaryMobility"
"""Of every node type above."""

DRAWN_BY_DEFAULT: Final[Mapping[str, Mapping[str, str]]] = {
    "LinearMobility": {"speed": "0mps", "initialMovementHeading": "uniform(0deg, 360deg)"},
    "CircleMobility": {"speed": "0mps", "startAngle": "uniform(0deg, 360deg)"},
}
"""{mobility: {parameter: its default in NED}}, of those whose default is another one here."""

GRADYS_NETWORK = """
network GradysNetwork {
    parameters:
        int numUAVs = default(1);
        int numSensors = default(1);
    submodules:
        radioMedium: <default("Ieee802154NarrowbandScalarRadioMedium")> like IRadioMedium;
        quads[numUAVs]: MobileNode;
        sensors[numSensors]: MobileSensorNode;
        groundStation: GroundStation;
}
"""
"""What is known of this network without its NED file, in the form of one."""

# ---- renamed keys ------------------------------------------------------------------------------------------

RENAMED: Final = tuple(
    (re.compile(rf"(^|\.){before}$"), after)
    for before, after in (
        (r"mac\.(?:\*|dcf)\.rateSelection\.dataFrameBitrate", "bitrate"),
        (r"transmitter\.analogModel\.communicationRange", "transmitter.communicationRange"),
        (r"mobility\.telemetryFrequency", "mobility.telemetryInterval"),
    )
)
"""(end of a key, the end here)."""

GEOGRAPHIC: Final[Mapping[str, str]] = {
    "initialLatitude": "initialX",
    "initialLongitude": "initialY",
    "initialAltitude": "initialZ",
    "homeLatitude": "initialX",
    "homeLongitude": "initialY",
}
"""{parameter of a mobility: the coordinate here}. A DroneMobility starts at its home."""

ORIGIN: Final[Mapping[str, str]] = {
    "initialX": "sceneLatitude",
    "initialY": "sceneLongitude",
    "initialZ": "sceneAltitude",
}
"""{coordinate: parameter of the coordinate system}."""

CLASS_NAMES = ("protocolMobile", "protocolSensor", "protocolGround")
FILE_NAME, LOCATION, PROTOCOL = "protocolFileName", "customProtocolLocation", "protocol"
"""Parameters of GrADyS' protocols in Python: the class, and where it is."""

# ---- renamed values ----------------------------------------------------------------------------------------

UNIT_DISK_MEDIUM = "UnitDiskRadioMedium"
UNIT_DISK: Final = (
    ("signalAnalogRepresentation", ("unitDisk",)),
    ("radio.typename", ("UnitDiskRadio", "Ieee80211UnitDiskRadio")),
)
"""(end of a key, its values) of radios without powers. Here the medium says that."""

VALUES: Final[Mapping[str, Mapping[str, str]]] = {
    "mobility.typename": {
        "DroneMobility": "MasslessMobility",
        "DroneMobilityMav": "ArdupilotMobility",
        "PythonDroneMobility": "MasslessMobility",
        "MAVLinkFileMobility": "ArdupilotMobility",
        "MAVLinkRandomWaypointMobility": "ArdupilotMobility",
    },
    "radioMedium.typename": {
        "RadioMedium": "Ieee80211ScalarRadioMedium",
        "Ieee80211RadioMedium": "Ieee80211ScalarRadioMedium",
        "Ieee80211DimensionalRadioMedium": "Ieee80211ScalarRadioMedium",
    },
}
"""{end of a key: {value: the value here}}."""

# ---- lines that are left out -------------------------------------------------------------------------------

_APPS = "the protocol of a node sends its messages"
_ENERGY = "there are no energy models"
_ADDRESSES = "nodes are addressed by their ids"
_QOS = "there is no QoS, aggregation or block ACK"
_MANAGEMENT = "all nodes are ad hoc"
_SHOWN = "only OMNeT++ shows it"
_QUEUES = "a node has one queue, `mac.dcf.channelAccess.pendingQueue.packetCapacity` long"
_BEACONS = "there are no beacons, slots or schedules"

NO_MEANING: Final[Mapping[str, str]] = {
    "app": _APPS,
    "numApps": _APPS,
    "packetName": _APPS,
    "ipv4": _ADDRESSES,
    "ipv6": _ADDRESSES,
    "arp": _ADDRESSES,
    "configurator": _ADDRESSES,
    "routingApp": _ADDRESSES,
    "energyStorage": _ENERGY,
    "energyGenerator": _ENERGY,
    "energyManagement": _ENERGY,
    "energyConsumer": _ENERGY,
    "hasStatus": "nodes do not fail",
    "failures": "there are no failure models",
    "numFailures": "there are no failure models",
    "visualizer": _SHOWN,
    "osgModel": _SHOWN,
    "displayCommunicationRange": _SHOWN,
    "displayInterferenceRange": _SHOWN,
    "initFromDisplayString": "positions are in the file",
    "coordinateSystemModule": "geographic positions became x, y and z",
    "sceneHeading": "x is North",
    "ground": "the ground is flat, at z = 0",
    "physicalEnvironmentModule": "obstacles are below `environment`",
    "waypointProximity": "it had no effect",
    "homeX": "it had no effect",
    "homeY": "it had no effect",
    "homeZ": "it had no effect",
    "startTime": "the protocol decides when it flies",
    "vehicleType": "the autopilot is ArduCopter",
    "waitUntilReady": "a run begins when all autopilots are ready",
    "hcf": _QOS,
    "qosStation": _QOS,
    "classifier": _QOS,
    "mgmt": _MANAGEMENT,
    "agent": _MANAGEMENT,
    "mib": _MANAGEMENT,
    "queue": _QUEUES,
    "responseAckFrameBitrate": "ACKs have the rate that the standard says",
    "sameTransmissionStartTimeCheck": "frames that start together collide",
    "mediumLimitCache": "the medium finds its own limits",
    "numSlots": _BEACONS,
    "slotDuration": _BEACONS,
    "reservedMobileSlots": _BEACONS,
    "fragmentationPolicy": "there is no fragmentation",
    "fragmentationThreshold": "there is no fragmentation",
    "signalAnalogRepresentation": "signals have one power, as with scalar",
    "frequencyGains": "signals have one power, as with scalar",
    "analogModel": "signals have one power, as with scalar",
    "snirThresholdMode": "the lowest SNIR counts",
    "radioMediumModule": "there is one medium",
    "forwarding": "protocols forward messages",
}
"""{name of a module or of a parameter: why it has no meaning here}."""

NO_RADIO_TYPE = "the interface and the medium say what its radio is"
NO_AREA = "nothing limits the area of such nodes"

# ---- lines that the user writes ----------------------------------------------------------------------------

TO_WRITE: Final[Mapping[str, tuple[str, str]]] = {
    "mobility.waypointFile": ("", "the mission is one of the protocol (docs/how-to/fly-a-mission.md)"),
    "mobility.copterSimulatorPath": ('autopilotPath = "arducopter"', "the program that flies the node"),
    "mobility.paramPath": ('autopilotParameters = "..."', "what differs from ArduCopter's parameters"),
    "physicalEnvironment.config": ('*.environment.obstacles = "FILE.geojson"', "the obstacles"),
}
"""{end of a key: (the line here, what it is for)}; "" for a line that has no counterpart."""
