"""Keys of where a node starts, how it is turned, and how it moves."""

from gradysim.scenario.keys.key import Key
from gradysim.scenario.keys.shapes import Below, angle
from gradysim.scenario.parameter_types import (
    boolean,
    choice,
    coordinate,
    file_name,
    integer,
    place,
    quantity,
    text,
)

MASSLESS = "MasslessMobility"
STATIONARY = "StationaryMobility"
ARDUPILOT = "ArdupilotMobility"
"""A node flown by an ArduCopter of its own."""

_own = Below("mobility", "mobility")
_flight = _own.only_for("mobility.typename", MASSLESS, ARDUPILOT, shown="")
_autopilot = Below("mobility", "autopilot").only_for("mobility.typename", ARDUPILOT, shown="")
_start = Below("mobility", "position")

STATIC_GRID = "StaticGridMobility"
"""A node that stands still, and starts in a grid."""

MOBILITY_KEYS: tuple[Key, ...] = (
    _own(
        "typename",
        "typename",
        choice(
            MASSLESS,
            STATIONARY,
            STATIC_GRID,
            ARDUPILOT,
            otherwise="protocols move their nodes here, with plugins for waypoints, random trips and more"
            " (docs/guides/plugins.md)",
        ),
        "How it moves: as its protocol says (missions, random waypoints: docs/guides/plugins.md), or not;"
        " StaticGridMobility: it does not, and starts in a grid; ArdupilotMobility: as its protocol says,"
        " flown by a real autopilot (docs/guides/ardupilot.md)",
    ),
    _start(
        "initialX",
        "initial_x",
        place(),
        "Where it starts, x; of initialX, lineStartX/lineStepX and a grid the one that is written first is in"
        " force",
        default="0m",
    ),
    _start("initialY", "initial_y", place(), "The same for y", default="0m"),
    _start("initialZ", "initial_z", place(), "The same for z: height", default="0m"),
    _start(
        "lineStartX",
        "line_start_x",
        coordinate(),
        "Nodes in a line: x of the node with index 0",
        default="0m",
    ),
    _start("lineStartY", "line_start_y", coordinate(), "The same for y", default="0m"),
    _start("lineStartZ", "line_start_z", coordinate(), "The same for z", default="0m"),
    _start(
        "lineStepX",
        "line_step_x",
        quantity("m"),
        "Nodes in a line: x from one index to the next",
        default="0m",
    ),
    _start("lineStepY", "line_step_y", quantity("m"), "The same for y", default="0m"),
    _start("lineStepZ", "line_step_z", quantity("m"), "The same for z", default="0m"),
    _start(
        "separationX",
        "separation_x",
        quantity("m"),
        "Nodes in a grid, which may fly from there: x from one column to the next; they start in the middle"
        " of cells of that size",
        default="none",
    ),
    _start("separationY", "separation_y", quantity("m"), "The same for y and rows", default="none"),
    _start(
        "marginX", "margin_x", coordinate(), "Nodes in a grid: x where the first cell begins", default="0m"
    ),
    _start("marginY", "margin_y", coordinate(), "The same for y", default="0m"),
    _start(
        "columns",
        "columns",
        integer(1),
        "Nodes in a grid: how many are in a row, along x; by default as many as there are rows, or one more",
        default="none",
    ),
    _start(
        "rows", "rows", integer(1), "How many rows there are; by default as many as it takes", default="none"
    ),
    _start(
        "numHosts",
        "num_hosts",
        integer(1),
        "Nodes in a grid: for how many it is; those of the group by default",
        default="none",
    ),
    _flight(
        "speed",
        "speed_mps",
        quantity("mps", at_least=0),
        "Speed until the protocol sets another, as every mission of the plugin does",
    ),
    _own(
        "telemetryInterval",
        "telemetry_interval_s",
        quantity("s", at_least=0, shown="ms"),
        "Time between two calls of handle_telemetry, at least 1us; 0s for none. In prototype mode it comes"
        " with the first update of all positions at or after its time: these are every 10ms, or as often as"
        " the shortest interval says, which beside autopilots may not be less",
    ),
    _own("initialHeading", "initial_heading_rad", angle(), "How it is turned at the start: from x towards y"),
    _own("initialElevation", "initial_elevation_rad", angle(), "The same upwards"),
    _own("initialBank", "initial_bank_rad", angle(), "The same about its own x axis, from y towards z"),
    _flight(
        "faceForward",
        "face_forward",
        boolean(),
        "Whether heading and elevation follow the direction of flight",
    ),
    _autopilot(
        "autopilotPath",
        "program",
        file_name(),
        "ArdupilotMobility: an arducopter program for SITL; without it that of the environment variable"
        " GRADYSIM_ARDUPILOT, or the command arducopter",
        default="none",
    ),
    _autopilot(
        "autopilotUser",
        "user",
        text(),
        'ArdupilotMobility: whom the autopilot belongs to if root runs the simulation; "" for root',
        default='"nobody"',
    ),
    _autopilot(
        "autopilotParameters",
        "parameters",
        text(),
        'ArdupilotMobility: ArduCopter\'s parameters, "WPNAV_SPEED_UP=500 SIM_WIND_SPD=8"',
        default="none",
    ),
)
