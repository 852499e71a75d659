"""Arguments that several commands have."""

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

Mode = Literal["integrated", "prototype"]
"""The same as in `gradysim.results.run_result`, which `gradysim --help` does not load."""

FileArgument = Annotated[Path, Parameter(name="FILE", help="The .ini file.")]
ConfigOption = Annotated[str, Parameter(alias="-c", help="Name of the configuration: a section of the file.")]
SetOption = Annotated[
    tuple[str, ...],
    Parameter(
        name="--set",
        negative="",
        show_default=False,
        help="KEY=VALUE: takes precedence over the file; may be repeated.",
    ),
]
