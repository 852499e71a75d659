from dataclasses import dataclass


@dataclass
class Telemetry:
    current_position: tuple[float, float, float]
