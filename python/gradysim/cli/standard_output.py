"""Standard output, whose errors say that they are about it.

What the system says of a write, such as "no space left", names no file: nothing would tell it from an error
about anything else.
"""

from io import BufferedWriter, FileIO, TextIOWrapper
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

NAME = "standard output"


class _Named(FileIO):
    def __init__(self, stream: TextIO) -> None:
        super().__init__(stream.fileno(), "wb", closefd=False)
        self._stream = stream  # which closes the file when it is gone

    def write(self, data: "ReadableBuffer", /) -> int:
        try:
            return super().write(data)
        except OSError as error:
            error.filename = NAME
            raise


def named_output(stream: TextIO) -> TextIO:
    """Return a stream to where `stream` writes, in which no letter is an error: it is written as an escape.

    One that writes to no file is returned as it is.
    """
    if not isinstance(stream, TextIOWrapper):
        return stream
    raw = getattr(stream.buffer, "raw", stream.buffer)
    if type(raw) is not FileIO:
        return stream
    stream.flush()
    named = _Named(stream)
    return TextIOWrapper(
        named if raw is stream.buffer else BufferedWriter(named),
        encoding=stream.encoding,
        errors="backslashreplace" if stream.errors == "strict" else stream.errors,
        line_buffering=stream.line_buffering,
        write_through=stream.write_through,
    )


def is_about_output(error: BaseException | None) -> bool:
    """Return whether writing to a stream of `named_output` failed."""
    return isinstance(error, OSError) and error.filename == NAME
