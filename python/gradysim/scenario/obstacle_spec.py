"""The data of an obstacle."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from gradysim.scenario.errors import Source
from gradysim.scenario.schema.keys import DEFAULT_MATERIAL

Corner = tuple[float, float]
"""x and y in meters."""

Ring = tuple[Corner, ...]
"""Corners of a closed line. The last corner is joined to the first."""


@dataclass(frozen=True)
class ObstacleSpec:
    """A body with vertical walls.

    Attributes:
        name: Name in messages: "obstacle[0]", or file and feature.
        rings: The footprint. Rings within the first one are courtyards.
        base_m: z of the floor in meters.
        top_m: z of the roof in meters.
        source: Where it was written, or where its file was named.
        material: Name in the engine's table of materials.
        relative_permittivity: Replaces that of the material; -1 keeps it.
        conductivity_spm: Replaces that of the material, in S/m; -1 keeps it.
        sources: Where its values were written, by the targets of their keys.
        label: Its name alone, without the file; "" if it has none.
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
    label: str = ""
