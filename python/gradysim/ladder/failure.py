"""Why a run failed: the exception of a protocol, or the end of its process."""

import traceback
from dataclasses import dataclass
from pathlib import Path

from gradysim.protocol.errors import NativeProtocolError

_PACKAGE = Path(__file__).resolve().parent.parent


@dataclass(frozen=True)
class Failure:
    """A run that did not come to its end.

    Attributes:
        exception: Name of the exception's class.
        message: Its first line.
        where: Callback, node and simulated time, as in its note; "" outside of callbacks.
        line: Last line of the user's code, `FILE:NUMBER`; "" if none was involved.
    """

    exception: str
    message: str
    where: str = ""
    line: str = ""

    @classmethod
    def of(cls, error: BaseException) -> "Failure":
        """Describe an exception."""
        frames = [] if isinstance(error, NativeProtocolError) else traceback.extract_tb(error.__traceback__)
        of_user = [each for each in frames if not Path(each.filename).is_relative_to(_PACKAGE)]
        return cls(
            type(error).__name__,
            next(iter(str(error).splitlines()), ""),
            next(iter(getattr(error, "__notes__", ())), ""),
            f"{of_user[-1].filename}:{of_user[-1].lineno}" if of_user else "",
        )

    def __str__(self) -> str:
        text = f"{self.exception}: {self.message}" if self.message else self.exception
        return ", ".join(filter(None, (text, self.where, self.line)))
