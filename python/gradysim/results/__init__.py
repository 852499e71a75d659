"""Results of runs, in the same shape for both modes.

`runs` returns the runs of a study as a table for pandas and polars. `read_means` returns their means, as
`gradysim means` prints them. `estimate` returns the mean of your own numbers with its confidence interval,
and `compare_pairs` compares those of two settings. `read_scalars` and `read_vectors` read the files
of `gradysim run --scalars` and `--vectors`, `read_replay` those of `--replay`.
"""

from gradysim.replay.reader import read_replay
from gradysim.results.confidence_interval import Estimate, estimate
from gradysim.results.means import Mean, read_means
from gradysim.results.omnetpp_reader import read_scalars, read_vectors
from gradysim.results.paired import Comparison, compare_pairs
from gradysim.results.run_table import Runs, runs

__all__ = [
    "Comparison",
    "Estimate",
    "Mean",
    "Runs",
    "compare_pairs",
    "estimate",
    "read_means",
    "read_replay",
    "read_scalars",
    "read_vectors",
    "runs",
]
