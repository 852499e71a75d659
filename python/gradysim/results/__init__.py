"""What a run leaves behind, in the same shape for both modes.

`read_means` reads the files of many runs, as `gradysim means` does, and `mean_with_half_width` makes the same
of numbers of one's own. `read_scalars` and `read_vectors` read the files of `gradysim run --scalars` and
`--vectors`.
"""

from gradysim.results.means import Mean, read_means
from gradysim.results.read_files import read_scalars, read_vectors
from gradysim.results.student import mean_with_half_width

__all__ = ["Mean", "mean_with_half_width", "read_means", "read_scalars", "read_vectors"]
