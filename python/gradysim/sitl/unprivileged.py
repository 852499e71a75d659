"""To run somebody else's program without the rights of root."""

import os
import pwd
import shutil
from collections.abc import Sequence

from gradysim.sitl.error import SitlError

DEFAULT_USER = "nobody"
"""Whom autopilots that root starts belong to."""


def user_for(wanted: str | None) -> str | None:
    """Return the user whom the program is to belong to: the one wanted if root asks, otherwise None.

    Raises:
        SitlError: There is no such user, or a tool for it is missing.
    """
    if wanted is None or os.geteuid() != 0:
        return None
    try:
        pwd.getpwnam(wanted)
    except KeyError:
        raise SitlError(f"there is no user {wanted!r} to run the autopilots as") from None
    for tool in ("setpriv", "timeout"):
        if shutil.which(tool) is None:
            raise SitlError(f"to run autopilots as {wanted!r} root needs the command {tool}")
    return wanted


def command_as(user: str | None, command: Sequence[str]) -> list[str]:
    """Return the command that runs a command as a user, None for who asks. It is killed when its parent ends.

    An autopilot that has given up, over a parameter that it does not know, sees to nothing any more, not even
    to the end of its connection; so the kernel does, where there is `setpriv`.

    ArduPilot ends when it cannot signal its parent, which nobody but root may do if the parent is root's. So
    `setpriv` gives up root's rights, and `timeout`, with no limit, stays as a parent of the same user; it
    passes signals on.
    """
    mortal = ["setpriv", "--pdeathsig=KILL"]
    if user is None:
        return [*(mortal if shutil.which("setpriv") else []), *command]
    group = str(pwd.getpwnam(user).pw_gid)
    rights = [f"--reuid={user}", f"--regid={group}", "--clear-groups", "--no-new-privs"]
    return [*mortal, *rights, "timeout", "0", *mortal, *command]
