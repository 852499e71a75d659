"""Two ends of a link, for tests of its range."""

from pathlib import Path

from gradysim.scenario import Scenario, load_scenarios

_FILE = Path(__file__).parents[3] / "configs/fading.ini"


def link(*settings: str) -> Scenario:
    """Return a sender of 2000 broadcasts and ten sinks, from 100 m to 1 km."""
    overrides = [*settings, "*.sender.protocol.interval = 5ms", "**.radio.receiver.sensitivity = -120dBm"]
    overrides.append("*.receivers[*].protocol.count_from = 0s")
    return load_scenarios(_FILE, "FreeSpace", overrides=overrides)[0]
