"""Every public name of gradysim 0.8.2 exists here, too, with its parameters, defaults and values.

`published_names.txt` lists them as seen from outside: `inspect.signature` without annotations and `self`, the
members of enumerations, the values of constants, and the origins of exports. It leaves out the internals of
Raft (`raft_node`, the messages of `raft_message`) and of `ardupilot_mobility` (`Drone`, a client of another
program), and names that modules happen to import.
"""

import importlib
import inspect
import re
from collections.abc import Callable
from enum import Enum
from pathlib import Path
from typing import Any, NamedTuple

import pytest

NO_CONFIGURATION = "None instead of one default object that all callers would share; it means the same"
SEEDED = "new last parameter: the stream of random numbers, that of Python if there is none"

INTERFACE = "new keyword argument: through which network interface of the node it goes"
DELIBERATE = {
    "CommunicationCommand": ("(command_type, message, destination=None, *, interface=0)", INTERFACE),
    "SendMessageCommand": ("(message, destination, *, interface=0)", INTERFACE),
    "IProtocol": (": abstract handle_packet handle_timer initialize", "the others may be left out"),
    "SimulationBuilder.add_node": (
        "(protocol, position, name='')",
        "new last parameter: for messages by name",
    ),
    "BroadcastMessageCommand": ("(message, *, interface=0)", INTERFACE),
    "ConsequenceType": (
        ": COMMUNICATION=0, MOBILITY=1, TIMER=2, TRACK_VARIABLE=3, CANCEL_TIMER=4",
        "new member",
    ),
    "MobilityLeaderConfiguration": (
        "(broadcast_interval=0.02, follower_timeout=5, initial_orientation=0.0, broadcast_jitter=0.5)",
        "new last field: without random delay leaders that were made together jam one another",
    ),
    "SimulationConfiguration": (
        "(duration=None, max_iterations=None, real_time=False, debug=False, log_file=None, "
        "execution_logging=True, profile=False, timing_report=False, seed=None)",
        "new last field",
    ),
    "MobilityFollowerPlugin": ("(protocol, configuration=None)", NO_CONFIGURATION),
    "MobilityLeaderPlugin": ("(protocol, configuration=None)", NO_CONFIGURATION),
    "MissionMobilityPlugin": ("(protocol, configuration=None)", NO_CONFIGURATION),
    "RandomMobilityPlugin": ("(protocol, config=None)", NO_CONFIGURATION),
    "ArdupilotMobilityConfiguration": (
        "(update_rate=0.1, default_speed=10, reference_coordinates=(0, 0, 0), generate_report=True, "
        "simulate_drones=True, ground_station_ip=None, starting_api_port=8000, ardupilot_path=None, "
        "uav_api_log_path=None, uav_api_startup_timeout=120, uav_api_log_console=False, "
        "simulation_startup_speedup=5, mavlink_streamrate=10, vehicle_addresses=None, "
        "autopilot_user='nobody', autopilot_parameters=None)",
        "new last fields: where real vehicles are; who owns simulated autopilots, and how they are set",
    ),
    "ArdupilotMobilityHandler": ("(configuration=None)", NO_CONFIGURATION),
    "CommunicationHandler": (
        "(communication_medium=None, ledger=None)",
        f"{NO_CONFIGURATION}; new last parameter: counts what becomes of each copy of a message",
    ),
    "MasslessMobilityHandler": ("(configuration=None)", NO_CONFIGURATION),
    "VisualizationHandler": ("(configuration=None)", NO_CONFIGURATION),
    "SimulationBuilder": ("(configuration=None)", NO_CONFIGURATION),
    "RaftConfig.get_random_election_timeout": ("(stream=None)", SEEDED),
    "can_transmit": ("(source_position, destination_position, medium, stream=None)", SEEDED),
    "SimulationFormatter": (
        "(clock=<function>)",
        "new last parameter: the text is made when a line is logged",
    ),
    "setup_simulation_formatter": (
        "(debug, log_file, *, quiet=False, clock=<function>)",
        "new keywords: for execution_logging=False, and the clock of the formatter",
    ),
}
"""Intended differences: name -> (our value, reason)."""


class Row(NamedTuple):
    """One published name: `what` is ": property", "(parameters)", " = value" and the like."""

    module: str
    name: str
    what: str


def published() -> list[Row]:
    rows: list[Row] = []
    module = ""
    for line in Path(__file__).with_name("published_names.txt").read_text().splitlines():
        if line.startswith(" "):
            match = re.fullmatch(r"  ([\w.]+)(.+)", line)
            assert match, line
            rows.append(Row(module, match[1], match[2]))
        else:
            module = line
    return rows


PUBLISHED = published()


def described(row: Row) -> str:
    """Return the row that our object of that name would have in the table."""
    container: Any = importlib.import_module(row.module)
    *classes, name = row.name.split(".")
    for each in classes:
        container = getattr(container, each)
    thing: Any = getattr(container, name)
    if row.what.startswith(" is "):
        origin, _, original = row.what.removeprefix(" is ").rpartition(".")
        same = thing is getattr(importlib.import_module(origin), original)
        return row.what if same else f" is another {original}"
    if isinstance(thing, property):
        return ": property"
    if isinstance(thing, type):
        return described_class(thing)
    if callable(thing):
        bound = isinstance(container, type) and not isinstance(
            inspect.getattr_static(container, name), staticmethod | classmethod
        )
        return parameters(thing, skip=1 if bound else 0)
    return f" = {thing!r}"


def described_class(thing: type) -> str:
    if issubclass(thing, Enum):
        return ": " + ", ".join(f"{name}={member.value!r}" for name, member in thing.__members__.items())
    if issubclass(thing, Exception):
        return ": exception"
    abstract: frozenset[str] | None = getattr(thing, "__abstractmethods__", None)
    return f": abstract {' '.join(sorted(abstract))}" if abstract else parameters(thing)


def parameters(thing: Callable[..., Any], skip: int = 0) -> str:
    signature = inspect.signature(thing)
    kept = [
        each.replace(annotation=inspect.Parameter.empty)
        for each in list(signature.parameters.values())[skip:]
    ]
    text = str(inspect.Signature(kept))
    return re.sub(r"<function .*? at 0x\w+>", "<function>", text)


def names(parameters: str) -> list[str]:
    """Return the names in "(a, b=C(x=1), *, d)"; optional ones end in "=", and so does the star."""
    inner = parameters[1:-1]
    while "(" in inner:
        inner = re.sub(r"\([^()]*\)", "", inner)
    return [re.sub(r"\*|=.*", "=", each) for each in inner.split(", ")]


@pytest.mark.parametrize("row", PUBLISHED, ids=[f"{row.module}.{row.name}" for row in PUBLISHED])
def test_a_published_name_is_as_it_was(row: Row) -> None:
    is_elsewhere = row.what.startswith(" is ")
    assert described(row) == (row.what if is_elsewhere else DELIBERATE.get(row.name, (row.what,))[0])


def test_environments_of_learning_get_what_their_annotations_need_where_they_get_the_simulator() -> None:
    from gradysim.simulator import event, node
    from gradysim.simulator.simulation import EventLoop, Node

    assert (EventLoop, Node) == (event.EventLoop, node.Node)


@pytest.mark.parametrize("name", DELIBERATE)
def test_a_use_that_was_right_still_is(name: str) -> None:
    (before,) = [row.what for row in PUBLISHED if row.name == name and not row.what.startswith(" is ")]
    now, _reason = DELIBERATE[name]
    assert now != before
    if before.startswith(": abstract"):
        assert set(now.split()) < set(before.split())
    elif before.startswith(":"):
        assert now.startswith(before)
    elif before != "()":
        known = names(before)
        assert names(now)[: len(known)] == known
        assert all(each.endswith("=") for each in names(now)[len(known) :])
