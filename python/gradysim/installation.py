"""Notice files of gradysim 0.8, which other authors publish, in the directory of this package.

Both have the same import package. pip lets two distributions overwrite files of each other without a word.
"""

import os
from collections.abc import Iterable

FILE_OF_08 = "simulator/handler/visualization.py"
"""Every 0.8 has it; here it is a package. A look for it takes microseconds, reading metadata milliseconds."""


def check(directories: Iterable[str]) -> None:
    """Raise ImportError if a directory of the package has files of gradysim 0.8."""
    for directory in directories:
        if os.path.exists(f"{directory}/{FILE_OF_08}"):
            raise ImportError(
                f"{directory} has files of two packages, gradysim 0.8 and this one; "
                "run `pip uninstall gradysim` until it finds none, then install the one that you want"
            )
