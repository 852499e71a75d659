"""What is shown of a simulation, how often and where."""

from dataclasses import dataclass

from gradysim.protocol.checked_values import checked_range
from gradysim.simulator.number_range import is_in_range


@dataclass
class VisualizationConfiguration:
    """Settings of a `VisualizationHandler`. ValueError names a wrong one.

    Attributes:
        information_collection_interval: Simulated time between two looks at the nodes, at most one of which
            is sent in each `update_rate`; also how soon a pause takes effect; s, > 0.
        update_rate: Wall time between two updates sent to the viewers; s, > 0.
        x_range: (least, greatest) x of the ground that is drawn; m.
        y_range: The same for y.
        z_range: The same for z.
        host: Address to listen on.
        port: Port to listen on; 0 for any that is free. The public viewer looks for 5678 on localhost.
        open_browser: Open the public viewer in a web browser when the simulation starts.
    """

    information_collection_interval: float = 0.01
    update_rate: float = 0.05
    x_range: tuple[float, float] = (-50, 50)
    y_range: tuple[float, float] = (-50, 50)
    z_range: tuple[float, float] = (0, 50)
    host: str = "localhost"
    port: int = 5678
    open_browser: bool = False

    def __post_init__(self) -> None:
        for name in ("information_collection_interval", "update_rate"):
            value = getattr(self, name)
            if not is_in_range(value, 0, above=True):
                raise ValueError(f"{name} must be finite and > 0 s, got {value!r}")
        for name in ("x_range", "y_range", "z_range"):
            checked_range(name, getattr(self, name), ValueError)
        if not isinstance(self.port, int) or not 0 <= self.port <= 65535:
            raise ValueError(f"port must be an integer from 0 to 65535, got {self.port!r}")
