"""All keys of .ini files, except options.

The names are INET's and OMNeT++'s. The engine declares the keys of its fields next to its structs
(cpp/netsim/config); all others are declared here, in the same form. Lists of keys show them in the order of
the tables at the end.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace

from gradysim.protocol.defaults import MOST_INTERFACES, TRANSMISSION_RANGE_M
from gradysim.scenario.parse.units import UNITS_IN_NAMES
from gradysim.scenario.schema.engine_keys import HAS_TO_BE_GIVEN, Key, ReadBy, engine_keys
from gradysim.scenario.schema.parameter_types import (
    CHANNEL_OF_802154,
    ParameterType,
    angle,
    channel_by_default,
    choice,
    coordinate,
    file_name,
    first_channel_of_band,
    integer,
    node_coordinate,
    number,
    quantity,
    si_number,
    text,
)

_ENGINE = engine_keys()


def engine_key(target: str) -> Key:
    """Return the key of a field of the engine: "radio.carrier_hz"."""
    return next(key for key in _ENGINE[target.partition(".")[0]] if key.target == target)


def _names(target: str) -> tuple[str, ...]:
    return engine_key(target).kind.names


@dataclass(frozen=True)
class _Below:
    """Creates keys below one path whose values go to one struct."""

    path: str
    struct: str
    read_by: ReadBy | None = None

    def __call__(self, name: str, kind: ParameterType, meaning: str, default: str, field: str = "") -> Key:
        """Return the key `path.name`, whose value goes to `struct.field`: `initial_x` for `initialX`."""
        field = field or re.sub("(?<=[a-z])(?=[A-Z])", "_", name).lower()
        return Key(f"{self.path}.{name}", f"{self.struct}.{field}", kind, meaning, default, self.read_by)


# ---- models, by the names that other keys give them --------------------------------------------------------

DEFAULT_INTERFACE, IEEE802154_INTERFACE = _names("interface.typename")
IEEE80211 = ReadBy("interface.typename", (DEFAULT_INTERFACE,), shown="")
IEEE802154 = ReadBy("interface.typename", (IEEE802154_INTERFACE,), shown="802.15.4")
"""The kinds of interface, for the keys that only one of them reads."""

RADIO_MEDIA = ReadBy("medium.typename", _names("medium.typename")[:2], shown="")
"""The media that have radios. With another one, nothing reads keys of radio, MAC and antenna."""


def has_radios(medium_typename: object) -> bool:
    """Return whether this medium has radios, so that powers determine ranges; in others the range counts."""
    return medium_typename in RADIO_MEDIA.names


LARGEST_DRIFT_PPM = 100_000.0

MASSLESS = "MasslessMobility"
QUADCOPTER = "QuadcopterMobility"
"""A vehicle with inertia, and a built-in controller."""
STATIONARY = "StationaryMobility"
STATIC_GRID = "StaticGridMobility"
"""A stationary node whose initial position is in a grid."""
LINEAR = "LinearMobility"
CIRCLE = "CircleMobility"
RECTANGLE = "RectangleMobility"
"""Nodes on given paths."""
ARDUPILOT = "ArdupilotMobility"
"""A node flown by its own ArduCopter."""

# ---- nodes -------------------------------------------------------------------------------------------------

_protocol = _Below("protocol", "protocol")
_mobility = _Below("mobility", "mobility")
_start = _Below("mobility", "position")
_autopilot = _Below("mobility", "autopilot", ReadBy("mobility.typename", (ARDUPILOT,), shown=""))

PROTOCOL_CLASS = _protocol(
    "class",
    text(),
    'What the node runs: "file.py:Class", relative to the .ini file, or "package.module:Class"',
    HAS_TO_BE_GIVEN,
)
PROTOCOL_TYPENAME = _protocol(
    "typename",
    text(),
    "Instead of a class, one of the engine's own protocols, listed below; integrated mode only",
    "none",
)
PROTOCOL_KEYS: tuple[Key, ...] = (PROTOCOL_CLASS, PROTOCOL_TYPENAME)
"""The two ways to choose the protocol of a node; the first match of both wins."""

PROTOCOL_PARAMETER = _protocol(
    "ATTRIBUTE",
    si_number(),
    "A public class attribute of the protocol: int, float, str, bool, or a list or tuple of these"
    " (docs/reference/values.md). Quantities become SI units, or the"
    " unit of the"
    ' annotation, `Annotated[float, "ms"]`, or the unit in which the name ends:'
    f" {', '.join(f'`_{unit.lower()}`' for unit in UNITS_IN_NAMES)}."
    " A parameter with such a unit accepts no other kind of quantity; angles need one."
    " A parameter named interval, timeout, period, delay, duration, jitter, spread or offset, or whose name"
    " ends so,"
    " should be a time; if it is not, there is a warning. All others accept any quantity",
    "the class's",
)
"""Represents all parameters in lists of keys; `parameters_of` returns those of a class."""

GROUP_SIZE = Key(
    "count",
    "group.count",
    integer(0, 1_000_000),
    "`*.uavs.count` means the same as `*.numUavs`",
    default="none",
)
"""Below the group, `*.uavs.count`; same as `*.numUavs`."""

GROUP_SIZE_OF_NODES = replace(
    GROUP_SIZE,
    path="numNodes",
    meaning="Number of nodes of the group `nodes`; `*.numUavs` is that of `uavs`, and so on."
    " Without this and `count`, the group is one node without an index",
)
"""Below the network. Stands for those of all groups in lists of keys; `find_groups` knows a file's."""

MOBILITY_KEYS: tuple[Key, ...] = (
    _mobility(
        "typename",
        choice(
            MASSLESS,
            QUADCOPTER,
            STATIONARY,
            STATIC_GRID,
            LINEAR,
            CIRCLE,
            RECTANGLE,
            ARDUPILOT,
            otherwise="protocols move their nodes here, with plugins for waypoints, random trips and more"
            " (docs/how-to/fly-a-mission.md, docs/how-to/move-at-random.md)",
        ),
        "How the node moves. MasslessMobility: as its protocol says (missions: docs/how-to/fly-a-mission.md, "
        "random waypoints: docs/how-to/move-at-random.md). QuadcopterMobility: the same with inertia "
        "(docs/how-to/fly-with-inertia.md). StationaryMobility: not at all. "
        "StaticGridMobility: not at all, and it starts in a grid. LinearMobility, CircleMobility and "
        "RectangleMobility: on a given path (docs/how-to/move-on-a-given-path.md). ArdupilotMobility: as its "
        "protocol says, flown by a real autopilot (docs/how-to/fly-with-ardupilot.md)",
        f'"{MASSLESS}"',
    ),
    _start(
        "initialX",
        node_coordinate(),
        "x at the start. Of initialX, lineStartX/lineStepX and a grid, the one that is written first counts",
        "0m",
    ),
    _start("initialY", node_coordinate(), "y at the start, as initialX", "0m"),
    _start("initialZ", node_coordinate(), "z at the start, which is the height, as initialX", "0m"),
    _start("lineStartX", coordinate(), "Nodes in a line: x of the node with index 0", "0m"),
    _start("lineStartY", coordinate(), "Nodes in a line: y of the node with index 0", "0m"),
    _start("lineStartZ", coordinate(), "Nodes in a line: z of the node with index 0", "0m"),
    _start("lineStepX", quantity("m"), "Nodes in a line: x from one index to the next", "0m"),
    _start("lineStepY", quantity("m"), "Nodes in a line: y from one index to the next", "0m"),
    _start("lineStepZ", quantity("m"), "Nodes in a line: z from one index to the next", "0m"),
    _start(
        "separationX",
        quantity("m"),
        "Nodes in a grid, which may fly from there: x from one column to the next. Nodes start "
        "in the middle of cells of that size",
        "none",
    ),
    _start("separationY", quantity("m"), "Nodes in a grid: y from one row to the next", "none"),
    _start("marginX", coordinate(), "Nodes in a grid: x where the first cell begins", "0m"),
    _start("marginY", coordinate(), "Nodes in a grid: y where the first cell begins", "0m"),
    _start(
        "columns",
        integer(1),
        "Nodes in a grid: number of nodes in a row, along x; by default the number of rows, or one more",
        "none",
    ),
    _start("rows", integer(1), "Number of rows; by default as many as needed", "none"),
    _start(
        "numHosts",
        integer(1),
        "Nodes in a grid: number of nodes that the grid is made for; by default that of the group",
        "none",
    ),
    *_ENGINE["mobility"],
    _autopilot(
        "autopilotPath",
        file_name(),
        "ArdupilotMobility: an arducopter program for SITL; by default that of the environment "
        "variable GRADYSIM_ARDUPILOT, or the command arducopter",
        "none",
        field="program",
    ),
    _autopilot(
        "autopilotUser",
        text(),
        'ArdupilotMobility: user that runs the autopilot if root runs the simulation; "" for root',
        '"nobody"',
        field="user",
    ),
    _autopilot(
        "autopilotParameters",
        text(),
        'ArdupilotMobility: ArduCopter\'s parameters, "WPNAV_SPEED_UP=500 SIM_WIND_SPD=8"',
        "none",
        field="parameters",
    ),
)

# ---- network interfaces ------------------------------------------------------------------------------------

WLAN = "wlan[0]"
"""First part of the paths of all keys of an interface; for other interfaces see `at_interface`."""

_INDEXED = re.compile(r"\bwlan\[(?:0|[1-9]\d*|\d*\.\.\d*)\]", re.ASCII)

NUM_WLAN_INTERFACES = Key(
    "numWlanInterfaces",
    "node.num_wlan_interfaces",
    integer(1, MOST_INTERFACES),
    "Number of network interfaces: wlan[0], wlan[1], and so on, each on a channel of its own",
    default="1",
)
DRIFT_RATE = Key(
    "clock.oscillator.driftRate",
    "node.drift_rate_ppm",
    quantity("ppm", at_least=-LARGEST_DRIFT_PPM, at_most=LARGEST_DRIFT_PPM),
    "How much faster than simulated time the clock of the protocol runs, with its timers; not for those of"
    " the engine",
    default="0ppm",
)
INTERFACE_TYPENAME = engine_key("interface.typename")
CENTER_FREQUENCY = engine_key("radio.carrier_hz")

BAND_NAME = replace(
    CENTER_FREQUENCY,
    path=f"{WLAN}.radio.bandName",
    kind=first_channel_of_band(),
    meaning="802.11: band in which channelNumber counts; without channelNumber, its channel 0",
)
CHANNEL_NUMBER = replace(
    CENTER_FREQUENCY,
    path=f"{WLAN}.radio.channelNumber",
    kind=channel_by_default(),
    meaning="Channel of the band (another way to set centerFrequency). 802.11: counted from 0, up to 13 in"
    " the 2.4 GHz band, which is the default; other bands are counted as in INET"
    " (docs/how-to/use-several-radios.md). 802.15.4: number of the standard, 11 (2405 MHz) to 26 (2480 MHz)",
)

OF_802154: dict[Key, Key] = {
    CHANNEL_NUMBER: replace(CHANNEL_NUMBER, kind=CHANNEL_OF_802154),
    BAND_NAME: replace(BAND_NAME, target="band.band_name", read_by=IEEE80211),
}
"""What stands for these two keys at an 802.15.4 interface, which has one band and reads no name."""

BAND_OF_CHANNEL = replace(BAND_NAME, target="band.of_channel")
BAND_BESIDE_FREQUENCY = replace(BAND_NAME, target="band.beside_frequency")
"""What stands for the name of a band at an 802.11 interface with a channel in it, or with a frequency."""


def at_interface(path: str, index: int) -> str:
    """Return the path of a key of wlan[0] for another interface."""
    return path.replace(WLAN, f"wlan[{index}]", 1)


def index_of_interface(path: str) -> int:
    """Return 3 for the path of a key of wlan[3], and 0 for that of a key of no interface."""
    return int(path[len("wlan[") : path.index("]")]) if path.startswith("wlan[") else 0


def interface_in(key: str) -> re.Match[str] | None:
    """Return the match of one interface, or a range, in the key of a line: `wlan[1]`, `wlan[2..5]`."""
    return _INDEXED.search(key)


def written_for(text: str, key: str) -> str:
    """A text that says `wlan[*]`, as people write keys, for the interface that `key` is about."""
    interface = interface_in(key)
    return text.replace("wlan[*]", interface[0]) if interface else text


# ---- the network -------------------------------------------------------------------------------------------

OBSTACLE_LOSS_KEYS = tuple(
    key
    for key in _ENGINE["medium"]
    if key.field in ("obstacle_loss", "enable_dielectric_loss", "enable_reflection_loss")
)
PATH_LOSS_EFFECTS = engine_key("medium.path_loss").effects
"""Names of the path losses in whose gains there is more than distance: "ground", "shadowing", "fading"."""
PATH_LOSS_KEYS = tuple(key for key in _ENGINE["medium"] if key.path.startswith("radioMedium.pathLoss."))

MATERIALS = _names("obstacle.material")
"""Names in the engine's table of materials."""
DEFAULT_MATERIAL = str(engine_key("obstacle.material").defaults[""])
"""Material of obstacles without one."""

_with_obstacles = ReadBy("medium.obstacle_loss", _names("medium.obstacle_loss")[1:], shown="")
_environment = _Below("environment", "environment", _with_obstacles)
_obstacle = _Below("environment.obstacle[0]", "obstacle", _with_obstacles)

NUM_OBSTACLES = _environment(
    "numObstacles", integer(0, 100_000), "Number of the obstacles `environment.obstacle[...]`", "0"
)
OBSTACLE_FILE = _environment(
    "obstacles", text(), "GeoJSON file with more obstacles, relative to the .ini file", "none"
)
OBSTACLE_KEYS: tuple[Key, ...] = (
    _obstacle("typename", choice("box", "prism"), "A box, or any footprint with vertical walls", '"box"'),
    *(
        _obstacle(f"{end}{axis}", coordinate(), meaning, HAS_TO_BE_GIVEN)
        for end, axis, meaning in (
            ("min", "X", "box: smallest x, before the box is turned"),
            ("max", "X", "box: largest x"),
            ("min", "Y", "box: smallest y"),
            ("max", "Y", "box: largest y"),
            ("min", "Z", "Height of the floor above z = 0"),
            ("max", "Z", "Height of the roof above z = 0"),
        )
    ),
    _obstacle(
        "heading",
        angle(),
        "box: how it is turned about its middle, from the x axis to the y axis",
        "0deg",
        field="heading_rad",
    ),
    _obstacle(
        "points",
        text(),
        'prism: x and y of the corners in meters, one after the other: "0 0 10 0 10 5"',
        HAS_TO_BE_GIVEN,
    ),
    *_ENGINE["obstacle"],
)
"""Those of one obstacle; in a list of keys it stands for all of them."""


def obstacle_path(key: Key, index: int) -> str:
    """The path of a key of OBSTACLE_KEYS for one obstacle."""
    return key.path.replace("[0]", f"[{index}]", 1)


_communication_medium = _Below("communicationMedium", "communication_medium")
_reference = _Below("coordinateSystem", "reference")

COMMUNICATION_MEDIUM_KEYS: tuple[Key, ...] = (
    _communication_medium(
        "transmissionRange",
        quantity("m", at_least=0),
        "Prototype mode: distance up to which a message arrives. By default the sender's "
        f"wlan[0].radio.transmitter.communicationRange, which both modes read, or {TRANSMISSION_RANGE_M:g}m "
        "without one. Radios of integrated mode reach 786 m by default",
        "none",
        field="transmission_range_m",
    ),
    _communication_medium(
        "delay",
        quantity("s", at_least=0),
        "Prototype mode: time from sending to arrival",
        "0s",
        field="delay_s",
    ),
    _communication_medium(
        "failureRate",
        number(at_least=0, at_most=1),
        "Prototype mode: fraction of the messages that is lost",
        "0",
    ),
)
COORDINATE_SYSTEM_KEYS: tuple[Key, ...] = (
    _reference(
        "sceneLatitude",
        quantity("deg", at_least=-90, at_most=90),
        "Latitude of the origin, for geographic coordinates",
        "0deg",
        field="latitude_deg",
    ),
    _reference(
        "sceneLongitude",
        quantity("deg", at_least=-180, at_most=180),
        "Longitude of the origin",
        "0deg",
        field="longitude_deg",
    ),
    _reference("sceneAltitude", quantity("m"), "Altitude of the origin", "0m", field="altitude_m"),
)

# ---- all of them -------------------------------------------------------------------------------------------

WLAN_KEYS: tuple[Key, ...] = (
    *_ENGINE["interface"],
    *_ENGINE["mac"],
    *_ENGINE["csma"],
    BAND_NAME,
    CHANNEL_NUMBER,
    *_ENGINE["radio"],
    *_ENGINE["antenna"],
)
"""Keys below a network interface, here wlan[0]."""

NODE_KEYS: tuple[Key, ...] = (
    *PROTOCOL_KEYS,
    *MOBILITY_KEYS,
    DRIFT_RATE,
    *_ENGINE["computer"],
    NUM_WLAN_INTERFACES,
    *WLAN_KEYS,
)
"""Keys below a node, as if each had one interface."""

NETWORK_KEYS: tuple[Key, ...] = (
    *(key for key in _ENGINE["medium"] if key not in OBSTACLE_LOSS_KEYS),
    *OBSTACLE_LOSS_KEYS,
    OBSTACLE_FILE,
    NUM_OBSTACLES,
    *OBSTACLE_KEYS,
    *COMMUNICATION_MEDIUM_KEYS,
    *COORDINATE_SYSTEM_KEYS,
    *_ENGINE["wind"],
)
"""Keys below the network."""

KEYS_BY_TARGET: Mapping[str, Key] = {
    key.target: key for key in (*OF_802154.values(), *NETWORK_KEYS, *NODE_KEYS)
}
"""The key of each field. Of several keys, the last one has the field's own unit."""

NETWORK_MODULES = frozenset(key.path.partition(".")[0] for key in NETWORK_KEYS)
"""Names below the network that are not groups of nodes."""
