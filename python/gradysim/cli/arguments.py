"""Arguments that several commands have."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

if TYPE_CHECKING:
    from cyclopts import Token

Mode = Literal["integrated", "prototype"]
"""The same as in `gradysim.results.result`, which `gradysim --help` does not load."""

FileArgument = Annotated[Path, Parameter(name="FILE", help="The .ini file.")]
ConfigOption = Annotated[str, Parameter(alias="-c", help="Name of the configuration: a section of the file.")]
SetOption = Annotated[
    tuple[str, ...],
    Parameter(
        name="--set",
        negative="",
        show_default=False,
        help="KEY=VALUE: takes precedence over the file; may be repeated, for other keys.",
    ),
]


def _whole_number(_type: type, tokens: "Sequence[Token]") -> int:
    """As int() has it. The number that cyclopts makes of `1.5` is 2, and another seed is another run."""
    text = tokens[0].value
    try:
        return int(text)
    except ValueError:
        raise ValueError(f"{text} is no whole number") from None


WholeNumber = Annotated[int, Parameter(converter=_whole_number, n_tokens=1)]
"""The type of an option that counts or numbers something."""
