"""Refuses files of a scenario that may have no end or no writer: devices, sockets, pipes with a name."""

import stat
from pathlib import Path

from gradysim.scenario.errors import BadValue


def check_regular(file: Path, name: str = "") -> None:
    """Raise BadValue if something is there that is not a regular file. `name` is what the message calls it.

    A pipe without a name is allowed, such as `/dev/stdin` behind `|` in a shell: it ends with its writer.
    OSError and ValueError, of names that no file can have, are left to the reader of the file.
    """
    try:
        mode = file.stat().st_mode
        has_name = not file.resolve().name.startswith("pipe:[")
    except (OSError, ValueError):
        return
    if not stat.S_ISREG(mode) and has_name:
        kind = next((kind for is_kind, kind in _KINDS.items() if is_kind(mode)), "no regular file")
        raise BadValue(f"{name or file} is {kind}", expected="a regular file")


_KINDS = {
    stat.S_ISDIR: "a directory",
    stat.S_ISCHR: "a device",
    stat.S_ISBLK: "a device",
    stat.S_ISFIFO: "a pipe",
    stat.S_ISSOCK: "a socket",
}
