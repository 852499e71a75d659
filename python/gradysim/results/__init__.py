"""What a run leaves behind, in the same shape for both modes.

`read_scalars` and `read_vectors` read the files of `gradysim run --scalars` and `--vectors`.
"""

from gradysim.results.read_files import read_scalars, read_vectors

__all__ = ["read_scalars", "read_vectors"]
