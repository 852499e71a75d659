"""One obstacle of a scenario, as the engine is given it."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from gradysim.scenario.errors import Source
from gradysim.scenario.keys.environment import DEFAULT_MATERIAL
from gradysim.scenario.obstacle.outline import Ring


@dataclass(frozen=True)
class ObstacleSpec:
    """A body with vertical walls.

    Attributes:
        name: For people, in messages: "obstacle[0]", or file and feature.
        rings: The footprint; rings within others are courtyards.
        base_m: z of the floor in metres.
        top_m: z of the roof in metres.
        source: Where it was written, or where its file was named.
        material: Of the engine's table.
        relative_permittivity: Instead of the material's; -1 for that.
        conductivity_spm: The same in S/m.
        sources: Where its values were written, by the targets of their keys.
    """

    name: str
    rings: tuple[Ring, ...]
    base_m: float
    top_m: float
    source: Source
    material: str = DEFAULT_MATERIAL
    relative_permittivity: float = -1.0
    conductivity_spm: float = -1.0
    sources: Mapping[str, Source] = field(default_factory=dict)
