"""What the lines of one run say of its network: the part of a scenario that runs have in common."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.errors.source import Source
from gradysim.scenario.file.sections import Ranked
from gradysim.scenario.geojson import read_obstacle_files
from gradysim.scenario.keys import NETWORK_KEYS
from gradysim.scenario.matching.groups import find_groups
from gradysim.scenario.matching.key_check import (
    NoSuchNodeError,
    ProtocolAndInterfaces,
    check_names,
    check_parameters,
)
from gradysim.scenario.matching.lookup import Lookup
from gradysim.scenario.matching.struct_reader import read_struct
from gradysim.scenario.native_protocols import file_of_native
from gradysim.scenario.node.interfaces import interface_counts
from gradysim.scenario.node.node_spec import NodeSpec
from gradysim.scenario.node.nodes import build_nodes, load_protocols
from gradysim.scenario.obstacles import ObstacleSpec, obstacle_count, read_obstacles
from gradysim.scenario.protocols import ProtocolLoader
from gradysim.scenario.runs import FileHashes
from gradysim.scenario.scenario import CommunicationMediumSpec
from gradysim.scenario.schema import Key
from gradysim.scenario.settings import Setting, SettingReader


@dataclass(frozen=True)
class Network:
    """Fields of a scenario under their names there, and what is needed to compare runs.

    Attributes:
        lines_of_other_runs: Those about nodes that this run has not, and others may have.
        lookup: Which lines are in force.
    """

    nodes: tuple[NodeSpec, ...]
    medium: Mapping[str, Setting]
    communication_medium: CommunicationMediumSpec
    reference_coordinates: tuple[float, float, float]
    obstacles: tuple[ObstacleSpec, ...]
    file_hashes: Mapping[str, str]
    lines_of_other_runs: Sequence[Source]
    lookup: Lookup


def read_network(
    ranked: list[Ranked],
    settings: SettingReader,
    loader: ProtocolLoader,
    hashes: FileHashes,
    instead: str,
    source: Source,
) -> Network:
    """Read the network of a run. Raises ConfigError for anything that is wrong.

    Args:
        ranked: The entries of the run, with its values in the place of variables.
        settings: Reads their values.
        loader: Loads protocols.
        hashes: Of the files that values name.
        instead: What messages about nodes that are not there end in.
        source: The place of the configuration.
    """
    lookup = Lookup(ranked)
    groups = find_groups(lookup, settings)
    try:
        lines_of_other_runs = check_names(lookup, groups)
    except NoSuchNodeError as error:
        raise NoSuchNodeError(error.message + instead, error.source) from None
    protocols = load_protocols(lookup, groups, settings, loader)
    if not protocols:
        for group in groups:  # each is given by the number of its nodes, and that is 0
            if group.size_found is not None:
                text = f"that is 0, and there are no nodes; expected one at least{instead}"
                raise ConfigError.at(group.size_found.entry.source, text)
        raise ConfigError(f"there are no nodes; expected some, such as `*.numUavs = 2`{instead}", source)
    counts = interface_counts(lookup, groups, settings)
    kinds = {name: ProtocolAndInterfaces(protocol.cls, counts[name]) for name, protocol in protocols.items()}
    check_parameters(lookup, groups, kinds, obstacle_count(lookup, settings))

    found = {
        key: entry for key in NETWORK_KEYS if (entry := lookup.first(*key.path.split(".", 1))) is not None
    }
    communication = read_struct("communication_medium", found, settings, _path_of)
    reference = read_struct("reference", found, settings, _path_of)
    latitude, longitude, altitude = (
        float(reference[field].value) if field in reference else 0.0
        for field in ("latitude_deg", "longitude_deg", "altitude_m")
    )
    nodes = build_nodes(lookup, groups, protocols, counts, settings)
    is_placed = {"latitude_deg", "longitude_deg"} <= reference.keys()
    obstacles = read_obstacles(lookup, settings)
    obstacle_files = read_obstacle_files(
        lookup, settings, (latitude, longitude, altitude) if is_placed else None
    )
    chosen = set(protocols.values())
    files = [file for protocol in chosen for file in protocol.files]
    files += [*obstacle_files, *settings.files()]
    return Network(
        nodes=nodes,
        medium=read_struct("medium", found, settings, _path_of),
        communication_medium=CommunicationMediumSpec(
            **{field: float(setting.value) for field, setting in communication.items()}
        ),
        reference_coordinates=(latitude, longitude, altitude),
        obstacles=(*obstacles, *chain.from_iterable(obstacle_files.values())),
        file_hashes=hashes.of(files, file_of_native(protocol.cls for protocol in chosen)),
        lines_of_other_runs=lines_of_other_runs,
        lookup=lookup,
    )


def _path_of(key: Key) -> str:
    """Of a parameter of the network."""
    return key.path
