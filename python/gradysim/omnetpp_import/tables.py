"""What lines of OMNeT++ become here: renamed keys and values, and the reasons for those left out.

Paths are below a node or below the network, as in `gradysim.scenario.schema.keys`. The facts are those of
the NED files of INET 4.5 and of GrADyS' C++ project.
"""

import re
from collections.abc import Mapping
from typing import Final

from gradysim import showcases

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

DEFAULT_PROTOCOL = "CommunicationProtocolBase"
"""In `SHOWCASES`, of every node type above: it does nothing."""

MOBILITY_DEFAULTS: Final[Mapping[str, Mapping[str, str]]] = {
    "LinearMobility": {"speed": "0mps", "initialMovementHeading": "uniform(0deg, 360deg)"},
    "CircleMobility": {"speed": "0mps", "startAngle": "uniform(0deg, 360deg)"},
    "DroneMobility": {"telemetryInterval": "100ms"},
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

SHOWCASES: Final = {name: getattr(showcases, name) for name in showcases.__all__}
"""{protocol of GrADyS' project: its class here}."""

APPS: Final = {"UdpSink": 'protocol.typename = "SinkProtocol"'}
"""{application: the line for the protocol here}, of those that are not in `SHOWCASES`."""

PROTOCOL_PARAMETERS: Final[Mapping[str, tuple[str, ...]]] = {
    "app.destAddresses": ("destinations", "hears"),
    "app.messageLength": ("message_length",),
    "app.sendInterval": ("send_interval",),
    "app.startTime": ("start_time",),
    "app.stopTime": ("stop_time",),
    "mobility.startTime": ("takeoff_time",),
    "mobility.waypointProximity": ("tolerance",),
    "mobility.waypointFile": ("mission",),
}
"""{end of a key below a node: parameters of a protocol in `SHOWCASES`, of which the first one counts}.

GrADyS' UdpCommunicationApp sends to all nodes, and ignores messages of nodes that are not its destinations.
"""

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
    },
}
"""{end of a key: {value: the value here}}."""

# ---- lines that are left out, and what is not modelled -----------------------------------------------------

OTHER_APP = "a node runs one protocol, in place of app[0]"
DRAWN = "a node draws it once, and not for each message"

NO_MEANING: Final[Mapping[str, str]] = {
    "the protocol of a node sends its messages": "app numApps packetName *Port",
    "nodes are addressed by their ids": "ipv4 ipv6 arp configurator networkConfiguratorModule netmaskRoutes",
    "only OMNeT++ shows it": "visualizer *Visualizer* osgModel display*",
    "positions are in the file": "initFromDisplayString",
    "the medium reads positions when it needs them": "updateInterval",
    "geographic positions became x, y and z": "coordinateSystemModule",
    "obstacles are below `environment`": "physicalEnvironmentModule",
    "the scene has no borders": "space*",
    "it had no effect": "waypointProximity homeX homeY homeZ",
    "the protocol decides when it flies": "startTime",
    "the autopilot is ArduCopter": "planeSimulatorPath roverSimulatorPath",
    "a run begins when all autopilots are ready": "waitUntilReady",
    "frames that start together collide": "sameTransmissionStartTimeCheck",
    "the medium finds its own limits": "mediumLimitCache",
}
"""{why it has no meaning here: names of modules and of parameters, with `*` for any letters}."""

_MANAGEMENT = "all nodes are ad hoc"
_ROUTES = "protocols forward messages, nodes do not"

NOT_MODELLED: Final[Mapping[str, str]] = {
    "there are no energy models": "energyStorage energyGenerator energyManagement energyConsumer",
    "there are no failure models": "hasStatus failures numFailures",
    "the MAC is DCF of 802.11, or CSMA/CA of 802.15.4": "mac",
    "there is no QoS, aggregation or block ACK": "hcf qosStation classifier",
    "a node has one queue, `mac.dcf.channelAccess.pendingQueue.packetCapacity` long": "queue",
    _MANAGEMENT: "mgmt agent mib",
    "there are no beacons, slots or schedules": "numSlots slotDuration reservedMobileSlots",
    "there is no fragmentation": "fragmentationPolicy fragmentationThreshold",
    "signals have one power, as with scalar": "frequencyGains signalAnalogRepresentation analogModel",
    "the lowest SNIR counts": "snir*Mode",
    "noise has a power, `radioMedium.backgroundNoise.power`": "powerSpectralDensity",
    "there are no noise sources": "noiseSource",
    "there is one medium": "radioMediumModule",
    "ACKs have the rate that the standard says": "responseAckFrameBitrate",
    _ROUTES: "routing* *Routing forwarding",
    "the ground is flat, at z = 0": "ground",
    "x is North": "sceneHeading",
    "the autopilot is ArduCopter": "vehicleType",
}
"""{what there is instead: names of modules and of parameters, with `*` for any letters}.

Some of them change nothing with the values in `AS_HERE`. Names that are not in these tables are not modelled.
"""

AS_HERE: Final[Mapping[str, set[str]]] = {
    "hasStatus": {"false"},
    "numFailures": {"0"},
    "qosStation": {"false"},
    "isBlockAckSupported": {"false"},
    "msduAggregationPolicy.typename": {""},
    "queue.typename": {"DropTailQueue"},
    "mgmt.typename": {"Ieee80211MgmtAdhoc"},
    "agent.typename": {""},
    "signalAnalogRepresentation": {"scalar"},
    "analogModel.typename": {"ScalarMediumAnalogModel", "ScalarAnalogModel"},
    "snirThresholdMode": {"min"},
    "ground.typename": {"FlatGround"},
    "ground.elevation": {"0m"},
    "sceneHeading": {"0deg"},
    "vehicleType": {"1"},
    "mac.typename": {"Ieee80211Mac", "Ieee802154NarrowbandMac"},
}
"""{end of a key: values with which a node does what it does here}."""

SCALAR_RADIOS: Final = {
    "Ieee80211Radio",
    "Ieee80211ScalarRadio",
    "Ieee802154NarrowbandRadio",
    "Ieee802154NarrowbandScalarRadio",
}

NOT_MODELLED_NODES: Final[Mapping[str, str]] = {
    "AccessPoint": _MANAGEMENT,
    "ManetRouter": _ROUTES,
}
"""{type of a node in `NODE_TYPES`: what there is instead}."""

NO_NODE_TYPE = "a node is a radio and a protocol, which forwards messages itself"
NO_RADIO_TYPE = "the interface and the medium say what its radio is"
NO_AREA = "nothing limits the area of such nodes"

# ---- lines that the user writes ----------------------------------------------------------------------------

CLASS_TO_WRITE = 'protocol.class = "FILE.py:CLASS"'

TO_WRITE: Final[Mapping[str, tuple[str, str]]] = {
    "mobility.waypointFile": ("", "the mission is one of the protocol (docs/how-to/fly-a-mission.md)"),
    "mobility.copterSimulatorPath": ('autopilotPath = "arducopter"', "the program that flies the node"),
    "mobility.paramPath": ('autopilotParameters = "..."', "what differs from ArduCopter's parameters"),
    "physicalEnvironment.config": ('*.environment.obstacles = "FILE.geojson"', "the obstacles"),
}
"""{end of a key: (the line here, what it is for)}; "" for a line that has no counterpart."""
