"""The traceback of an exception in a protocol, from the user's code on."""

import traceback
from pathlib import Path
from types import TracebackType
from typing import TextIO

from gradysim.protocol.errors import NativeProtocolError

PACKAGE = Path(__file__).resolve().parent.parent


def print_failure(failure: BaseException, file: TextIO) -> None:
    """Print `failure` with its notes; the frames of gradysim that led to the user's code are left out."""
    is_native = isinstance(failure, NativeProtocolError)
    frames = None if is_native else from_users_code(failure.__traceback__)
    traceback.print_exception(type(failure), failure, frames, file=file)


def from_users_code(frames: TracebackType | None) -> TracebackType | None:
    """Return `frames` from the first one outside this package; all of them if there is none."""
    first = frames
    while first is not None and is_ours(first.tb_frame.f_code.co_filename):
        first = first.tb_next
    return first if first is not None else frames


def is_ours(filename: str) -> bool:
    """Return whether a source file belongs to the package gradysim."""
    return Path(filename).is_relative_to(PACKAGE)
