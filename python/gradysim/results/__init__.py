"""Results of runs, in the same shape for both modes.

`read_means` reads the result files of many runs, as `gradysim means` does. `mean_with_half_width` returns the
mean of your own numbers with its confidence interval. `read_scalars` and `read_vectors` read the files of
`gradysim run --scalars` and `--vectors`.
"""

from gradysim.results.confidence_interval import mean_with_half_width
from gradysim.results.means import Mean, read_means
from gradysim.results.omnetpp_reader import read_scalars, read_vectors

__all__ = ["Mean", "mean_with_half_width", "read_means", "read_scalars", "read_vectors"]
