"""The result of one run, in the same shape for both modes.

To add a number, declare a field here and fill it in `measured()` of `gradysim.integrated.run` or
`gradysim.prototype.run`. All outputs follow from the declaration; see `Quantity`.
"""

import contextlib
import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Annotated, Any, Literal

from gradysim.notebook import HEIGHT_PX, ReplayView, html_table
from gradysim.results.delays import Delays, Histogram, delay_averages, delay_histograms, delay_scalars
from gradysim.results.outcomes import (
    Counts,
    Outcomes,
    count_scalars,
    interface_scalars,
    outcome_ratios,
    outcome_scalars,
    plain_counts,
)
from gradysim.results.quantity import Quantity, Scalar, json_object, recorded, scalars_of
from gradysim.results.recorder import Vector
from gradysim.results.result_hash import OF_RUN, result_hash
from gradysim.results.tracked_variables import tracked_scalars
from gradysim.scenario.parse.functions import is_quoted, unquoted

Mode = Literal["integrated", "prototype"]

_LIKE_A_NUMBER = re.compile(r"[-+.eE\d]+", re.ASCII)
"""Python takes `2026_11` for a number, too."""


def plain_iterations(values: Mapping[str, str]) -> dict[str, int | float | str]:
    """Return the values of iteration variables for JSON objects."""
    return {name: _plain_iteration(value) for name, value in values.items()}


def _plain_iteration(value: str) -> int | float | str:
    """Return a plain number as a number, a quoted string without its quotes, and other values as strings."""
    for number in (int, float) if _LIKE_A_NUMBER.fullmatch(value) else ():
        with contextlib.suppress(ValueError, OverflowError):
            if math.isfinite(number(value)):
                return number(value)
    return unquoted(value) if is_quoted(value) else value


def _position_scalars(position: tuple[float, float, float], node: str) -> Iterator[Scalar]:
    for axis, coordinate in zip("XYZ", position, strict=True):
        yield recorded(f"{node}.mobility", f"position{axis}:last", coordinate, "m")


def _bitrate_scalars(frames: Mapping[int, int], node: str) -> Iterator[Scalar]:
    for bitrate_bps, count in frames.items():
        yield recorded(node, f"unicast:{bitrate_bps / 1e6:g}Mbps:count", count)


def _interferer_scalars(interferers: Mapping[str, int], node: str) -> Iterator[Scalar]:
    for name, count in interferers.items():
        yield recorded(node, f"interferer:{name}:count", count)


@dataclass(frozen=True)
class NodeResult:
    """State of one node at the end of its run. The annotations describe the fields."""

    id: Annotated[int, Quantity("Id of the node, 0 to n-1.")]
    name: Annotated[str, Quantity("Name as in the scenario: `uavs[0]`, `groundStation`.")]
    protocol: Annotated[str, Quantity("Name of the protocol's class.")]
    position: Annotated[
        tuple[float, float, float],
        Quantity(
            "Position: x, y, z.",
            unit="m",
            scalar="`mobility`: `positionX:last`, …",
            scalars=_position_scalars,
        ),
    ]
    tracked_variables: Annotated[
        Mapping[str, Any],
        Quantity(
            "Last value of each variable that the protocol tracked, by its name.",
            scalar="`protocol`: `NAME:last`",
            mean="`GROUP[*] NAME`",
            scalars=tracked_scalars,
        ),
    ]
    frames_by_bitrate: Annotated[
        Mapping[int, int],
        Quantity(
            "With a [rate control](../how-to/adapt-the-bitrate.md): unicast frames sent at each bitrate (bits"
            " per second), with retries.",
            scalar="`unicast:54Mbps:count`",
            omitted=({},),
            to_json=lambda frames: {str(bitrate): count for bitrate, count in frames.items()},
            scalars=_bitrate_scalars,
        ),
    ] = field(default_factory=dict)
    frame_outcomes: Annotated[
        Counts | None,
        Quantity(
            "With `--outcomes-at`: `frame_outcomes[KIND][OUTCOME]`, receptions at this node of frames that"
            " were strong enough, for any destination.",
            scalar="`KIND:OUTCOME:count`",
            omitted=(None,),
            to_json=plain_counts,
            scalars=count_scalars,
        ),
    ] = None
    interferers: Annotated[
        Mapping[str, int] | None,
        Quantity(
            "With `--outcomes-at`: `interferers[NAME]`, receptions that were lost here to interference by"
            " frames of the node of that name, alone or with others.",
            scalar="`interferer:NAME:count`",
            omitted=(None,),
            to_json=dict,
            scalars=_interferer_scalars,
        ),
    ] = None
    message_outcomes: Annotated[
        Mapping[str, Counts] | None,
        Quantity(
            'With `--outcomes-at`: `message_outcomes["wlan[0]"][KIND][OUTCOME]`, messages that the protocol'
            " sent through each interface.",
            scalar="`wlan[0]`: `KINDMessage:OUTCOME:count`",
            omitted=(None,),
            to_json=lambda interfaces: {name: plain_counts(counts) for name, counts in interfaces.items()},
            scalars=interface_scalars,
        ),
    ] = None
    vectors: Annotated[
        tuple[Vector, ...] | None,
        Quantity(
            "With `--vectors`: numbers [over time](../how-to/use-omnetpp-tools.md#vectors). In scripts only.",
            in_json=False,
        ),
    ] = None

    def to_json_object(self) -> dict[str, object]:
        """Return the fields as plain values; see `plain_value`.

        `vectors` is left out, and so are fields that were not requested.
        """
        return json_object(self)


@dataclass(frozen=True)
class RunResult:
    """Results and cost of one run. The annotations describe the fields."""

    config: Annotated[str, Quantity("Name of the configuration in the `.ini` file.")]
    run: Annotated[int, Quantity("Run number in the configuration, from 0.")]
    seed: Annotated[int, Quantity("Seed of the run. By default, run *n* has the seed *n*.")]
    mode: Annotated[Mode, Quantity('"integrated" or "prototype".')]
    sim_time_s: Annotated[
        float,
        Quantity(
            "Simulated time that the run reached.",
            unit="s",
            scalar="simTime",
            summary="simulated time",
            digits=",.9g",
        ),
    ]
    wall_s: Annotated[
        float,
        Quantity(
            "Wall time of building and running.",
            unit="s",
            scalar="wallTime",
            summary="wall time",
            digits=".3f",
        ),
    ]
    cpu_s: Annotated[
        float,
        Quantity(
            "Processor time of building and running.",
            unit="s",
            scalar="cpuTime",
            summary="processor time",
            digits=".3f",
        ),
    ]
    events: Annotated[
        int,
        Quantity("Events that the simulator executed.", scalar="event:count", summary="events", digits=","),
    ]
    interrupted: Annotated[
        bool,
        Quantity("Whether Ctrl-C or an exception ended the run before its time limit: leave it out then."),
    ]
    fingerprint: Annotated[
        str | None,
        Quantity(
            "Hash of all frames, messages and timers in their order; `null` in prototype mode.",
        ),
    ]
    outcomes: Annotated[
        Outcomes,
        Quantity(
            "Outcomes of frames and messages, also those that are 0:"
            ' `outcomes["frames"][KIND][OUTCOME]` and `outcomes["messages"]`.',
            scalar="`radioMedium`: `KIND:OUTCOME:count`; `KINDMessage:OUTCOME:count`",
            mean="`KIND messages OUTCOME`, `KIND frames delivered`",
            scalars=outcome_scalars,
            averages=outcome_ratios,
        ),
    ]
    nodes: Annotated[
        tuple[NodeResult, ...],
        Quantity(
            "[Nodes](#fields-of-a-node) in the order of their ids.",
            to_json=lambda nodes: [node.to_json_object() for node in nodes],
        ),
    ]
    message_delays: Annotated[
        Mapping[str, Delays],
        Quantity(
            "[Delays](#delays) of broadcasts and of unicast messages, where protocols received any.",
            scalar="`KINDMessage:delay:mean`, `:max`, `:histogram`",
            mean="`KIND messages delay in s`",
            to_json=lambda delays: {kind: each.to_json_object() for kind, each in delays.items()},
            scalars=delay_scalars,
            averages=delay_averages,
        ),
    ] = field(default_factory=dict)
    repetition: Annotated[
        int, Quantity("Number among the runs with the same values of iteration variables, from 0.")
    ] = 0
    iterations: Annotated[
        Mapping[str, str],
        Quantity(
            'Value of each iteration variable: `{"jitter": "10ms"}` for `${jitter=1ms, 10ms}`.'
            " A plain number is a number, and a string has no quotes. In scripts all are as written.",
            to_json=plain_iterations,
        ),
    ] = field(default_factory=dict)
    settings_hash: Annotated[
        str,
        Quantity(
            "Hash of the settings of the run from the file and `--set`, without its seed: equal for all"
            " repetitions, unless a variable is in lock-step with them."
        ),
    ] = ""
    file_hashes: Annotated[
        Mapping[str, str],
        Quantity(
            'Hashes of the files that settings name, `{"hello.py": "1d2f…"}`: protocols with what they import'
            " from their folder, obstacles, error rates, and for [native protocols]"
            "(../how-to/write-a-native-protocol.md) the engine.",
            to_json=dict,
        ),
    ] = field(default_factory=dict)
    range_m: Annotated[
        float | None,
        Quantity(
            "Range of a node, the mean over all nodes: the distance at which half of its messages of 50 B"
            " arrive. `null` if it is unlimited.",
            unit="m",
            scalar="range",
        ),
    ] = None
    setup_s: Annotated[
        float,
        Quantity(
            "Part of `wall_s` in which the network and the protocols were built.",
            unit="s",
            scalar="setupTime",
            summary="setup time",
            digits=".3f",
        ),
    ] = 0.0
    replay_page: Annotated[
        str | None,
        Quantity(
            "With `replay` in `gradysim.run`: the page of the replay, HTML. In scripts only.", in_json=False
        ),
    ] = field(default=None, repr=False, compare=False)

    @cached_property
    def result_hash(
        self,
    ) -> Annotated[
        str,
        Quantity(
            "Hash of all that the run computed: `sim_time_s`, `fingerprint`, `outcomes`, `message_delays`,"
            " and the position, the tracked variables and `frames_by_bitrate` of each node. Two runs with one"
            " hash did the same."
        ),
    ]:
        """Return the hash of all that the run computed."""
        return result_hash(json_object(self, OF_RUN))

    def view(self, height_px: int = HEIGHT_PX) -> ReplayView:
        """Return the replay of a run of `gradysim.run(..., replay="all")`, which a notebook shows.

        Raises ValueError if the run was not recorded.
        """
        if self.replay_page is None:
            raise ValueError(f'{self.config} run {self.run} has no replay; expected run(…, replay="all")')
        return ReplayView(self.replay_page, height_px)

    def _repr_html_(self) -> str:
        """Return the last values of tracked variables and the outcomes as tables, for notebooks."""
        names = list(dict.fromkeys(name for node in self.nodes for name in node.tracked_variables))
        about = f"{self.config} run {self.run}, {self.mode} mode, seed {self.seed}, {self.sim_time_s:g} s"
        tracked = html_table(
            about + (", interrupted" if self.interrupted else ""),
            ("node", *names),
            [(node.name, *(node.tracked_variables.get(name, "") for name in names)) for node in self.nodes],
        )
        outcomes = html_table(
            "outcomes",
            ("of", "kind", "outcome", "count"),
            [
                (of, kind, outcome.replace("_", " "), f"{count:,}")
                for of, kinds in self.outcomes.items()
                for kind, counts in kinds.items()
                for outcome, count in counts.items()
                if count
            ],
        )
        return tracked + outcomes

    def to_json_object(self) -> dict[str, object]:
        """Return the result as plain dicts, lists, strings and numbers."""
        return json_object(self)

    def scalars(self, network: str) -> Iterator[Scalar]:
        """Yield the numbers of the run and of its nodes; the paths of their modules start with `network`."""
        yield from scalars_of(self, network)
        for node in self.nodes:
            yield from scalars_of(node, f"{network}.{node.name}")

    def histograms(self, network: str) -> Iterator[Histogram]:
        """Yield the distributions of the run."""
        return delay_histograms(self.message_delays, network)
