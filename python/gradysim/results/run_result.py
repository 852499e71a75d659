"""The result of one run, in the same shape for both modes.

`gradysim.prototype.run` and `gradysim.integrated.run` make it; the command line prints and writes it.
"""

import contextlib
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from gradysim.protocol.plain_value import plain_value
from gradysim.results.delays import Delays
from gradysim.results.vector import Vector
from gradysim.scenario.functions import is_quoted, unquoted

Mode = Literal["integrated", "prototype"]
Fates = Mapping[str, Mapping[str, Mapping[str, int]]]

_LIKE_A_NUMBER = re.compile(r"[-+.eE\d]+", re.ASCII)
"""Python takes `2026_11` for one, too."""


@dataclass(frozen=True)
class NodeResult:
    """What one node was at the end of its run.

    Attributes:
        id: 0 to n-1.
        name: As in the scenario: `uavs[0]`, `groundStation`.
        protocol: Name of the protocol's class.
        position: Where it ended: x, y, z in metres.
        tracked_variables: The last value of each variable that the protocol tracked.
        frames_by_bitrate: {bits per second: unicast frames sent at it, with retries}; empty for nodes without
            a rate control.
        frame_fates: {kind: {fate: copies}} of the frames that were strong enough to be received here, whoever
            they were for, without zeros; None unless the run was asked for it (`fates_at`). Kinds:
            "broadcast", "unicast", "ack", "rts", "cts"; copies that are too weak or in air are kept for the
            whole network only.
        interferers: {name of a node: copies that were lost here to interference by frames of that node, or of
            it and others}, in the order of ids; None as above. Of those on the air when the interference was
            at its strongest, the strongest are named, as many as outweigh all the others together; a copy
            counts once for each of them.
        message_fates: {interface: {kind: {fate: messages}}} of what its protocol sent through "wlan[0]",
            "wlan[1]" and so on, all that there are, without zeros; None as above. Kinds: "broadcast",
            "unicast".
        vectors: What its numbers were over time; None unless the run was asked for it (`vectors_of`). Not in
            JSON.
    """

    id: int
    name: str
    protocol: str
    position: tuple[float, float, float]
    tracked_variables: Mapping[str, Any]
    frames_by_bitrate: Mapping[int, int] = field(default_factory=dict)
    frame_fates: Mapping[str, Mapping[str, int]] | None = None
    interferers: Mapping[str, int] | None = None
    message_fates: Mapping[str, Mapping[str, Mapping[str, int]]] | None = None
    vectors: tuple[Vector, ...] | None = None

    def to_json_object(self) -> dict[str, object]:
        """Return the fields but `vectors` as plain values; see `plain_value` for those of other kinds.

        `frames_by_bitrate` is left out where it is empty; its keys are texts then. `frame_fates`,
        `interferers` and `message_fates` are left out where they are None.
        """
        rates = {str(bitrate): frames for bitrate, frames in self.frames_by_bitrate.items()}
        return {
            "id": self.id,
            "name": self.name,
            "protocol": self.protocol,
            "position": plain_value(self.position),
            "tracked_variables": plain_value(self.tracked_variables),
            **({"frames_by_bitrate": rates} if rates else {}),
            **self._fates(),
        }

    def _fates(self) -> dict[str, object]:
        """Return what was asked for: of large networks millions of counts, all of them plain already."""
        told: dict[str, object] = {}
        if self.frame_fates is not None:
            told["frame_fates"] = {kind: dict(counts) for kind, counts in self.frame_fates.items()}
        if self.interferers is not None:
            told["interferers"] = dict(self.interferers)
        if self.message_fates is not None:
            told["message_fates"] = {
                interface: {kind: dict(counts) for kind, counts in kinds.items()}
                for interface, kinds in self.message_fates.items()
            }
        return told


def plain_iterations(values: Mapping[str, str]) -> dict[str, int | float | str]:
    """Return the values of iteration variables as results have them."""
    return {name: _plain_iteration(value) for name, value in values.items()}


def _plain_iteration(value: str) -> int | float | str:
    """Return a plain number as one, the text that stands in quotes, and all else as it is written."""
    for number in (int, float) if _LIKE_A_NUMBER.fullmatch(value) else ():
        with contextlib.suppress(ValueError, OverflowError):
            if math.isfinite(number(value)):
                return number(value)
    return unquoted(value) if is_quoted(value) else value


@dataclass(frozen=True)
class RunResult:
    """What one run computed and what it cost.

    Attributes:
        config: Name of the configuration in the .ini file.
        run: Run number within the configuration, from 0.
        sim_time_s: Simulated time reached, in seconds.
        wall_s: Time that building and running took by the clock, in seconds.
        cpu_s: Processor time of building and running, in seconds.
        events: Events that the simulator executed.
        interrupted: Whether the run ended before its time limit: by the user, or by an exception in a
            protocol.
        fingerprint: Hash of all that happened; None in prototype mode.
        fates: {what: {kind: {fate: count}}}; `what` is "messages", and "frames" or, in prototype mode,
            "copies".
        nodes: In the order of their ids.
        message_delays: {"broadcast" or "unicast": how long they took} of the kinds of which a protocol got
            any.
        repetition: Number among the runs with the same values of iteration variables, from 0.
        iterations: {name of an iteration variable, `${x=1, 2}`: its value in this run, as a text}.
        settings_hash: Hash of what the .ini file and the command line say of this run, but for its seed.
        file_hashes: {name of a file that settings name, seen from the folder of the .ini file: its hash}.
    """

    config: str
    run: int
    seed: int
    mode: Mode
    sim_time_s: float
    wall_s: float
    cpu_s: float
    events: int
    interrupted: bool
    fingerprint: str | None
    fates: Fates
    nodes: tuple[NodeResult, ...]
    message_delays: Mapping[str, Delays] = field(default_factory=dict)
    repetition: int = 0
    iterations: Mapping[str, str] = field(default_factory=dict)
    settings_hash: str = ""
    file_hashes: Mapping[str, str] = field(default_factory=dict)

    def to_json_object(self) -> dict[str, object]:
        """Return the result as plain dicts, lists, text and numbers."""
        return {
            "config": self.config,
            "run": self.run,
            "seed": self.seed,
            "mode": self.mode,
            "sim_time_s": self.sim_time_s,
            "wall_s": self.wall_s,
            "cpu_s": self.cpu_s,
            "events": self.events,
            "interrupted": self.interrupted,
            "fingerprint": self.fingerprint,
            "fates": plain_value(self.fates),
            "nodes": [node.to_json_object() for node in self.nodes],
            "message_delays": {kind: each.to_json_object() for kind, each in self.message_delays.items()},
            "repetition": self.repetition,
            "iterations": plain_iterations(self.iterations),
            "settings_hash": self.settings_hash,
            "file_hashes": dict(self.file_hashes),
        }
