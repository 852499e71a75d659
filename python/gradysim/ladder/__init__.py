"""The realism ladder: a protocol under more and more effects of real radios and vehicles.

`Campaign` runs a configuration with any set of effects. `climb` measures a metric at each level, `Bisection`
finds the level that breaks a protocol, `desynchronize` the timers that send into each other.
`assert_survives` is a check for tests.
"""

from gradysim.ladder.assertion import Assertion
from gradysim.ladder.bisect import Bisection, Verdict
from gradysim.ladder.campaign import Campaign
from gradysim.ladder.desync import Desync, desynchronize
from gradysim.ladder.ladder import Rung, climb
from gradysim.ladder.survival import assert_survives

__all__ = [
    "Assertion",
    "Bisection",
    "Campaign",
    "Desync",
    "Rung",
    "Verdict",
    "assert_survives",
    "climb",
    "desynchronize",
]
