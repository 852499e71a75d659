"""What whoever asks for scenarios calls what he gives: messages about it begin with that."""

from dataclasses import dataclass


@dataclass(frozen=True)
class ArgumentNames:
    """The beginnings of messages, by default for a script, which calls `load_scenarios` itself.

    Attributes:
        overrides: What comes before KEY=VALUE.
        seed: What comes before a seed.
        runs: What comes before the numbers of runs.
        config: What comes before the name of a configuration.
    """

    overrides: str = "override"
    seed: str = "seed ="
    runs: str = "runs ="
    config: str = "config ="


OF_SCRIPT = ArgumentNames()
