"""The autopilot processes of one simulation."""

import asyncio
import os
import shutil
import signal
import time
import weakref
from collections.abc import Mapping
from pathlib import Path

from gradysim.protocol.defaults import AUTOPILOT_USER
from gradysim.protocol.position import Position
from gradysim.sitl import SitlError
from gradysim.sitl.arducopter import find_arducopter, free_instance, options, parameter_file
from gradysim.sitl.connection import StreamConnection
from gradysim.sitl.mavlink import MavlinkLink
from gradysim.sitl.process import (
    GRACE_S,
    AutopilotProcess,
    FleetDirectory,
    command_as,
    stop_all,
    user_for,
)

_HELP_S = 10.0
"""Limit of wall time for --help."""


class Fleet:
    """Starts autopilots, each with its own directory, and ends them.

    `close` ends all and removes their files. Without it, this happens when the fleet is garbage collected or
    Python ends. If Python is killed, the next fleet removes the files.
    """

    def __init__(
        self,
        program: str | os.PathLike[str] | None,
        *,
        user: str | None = AUTOPILOT_USER,
        console_folder: str | os.PathLike[str] | None = None,
        grace_s: float = GRACE_S,
    ) -> None:
        """Find the program, see `find_arducopter`, and create a directory. Raise SitlError if there is none.

        Autopilots that root starts belong to `user` (None: root). Their output goes to `autopilot_<id>.log`
        in `console_folder`, if there is one. `grace_s` is wall time between SIGTERM, which one that waits for
        physics ignores, and SIGKILL.
        """
        self._found = find_arducopter(program)
        self._user = user_for(user)
        self._consoles = None if console_folder is None else Path(console_folder).expanduser().absolute()
        if self._consoles is not None:
            self._consoles.mkdir(parents=True, exist_ok=True)
        files = FleetDirectory()
        self._folder = files.path
        self._processes: list[AutopilotProcess] = []
        self._end = weakref.finalize(self, _end, self._processes, files, grace_s)
        self._instances: set[int] = set()
        self._program = self._reachable(self._found)
        self._help: str | None = None

    async def launch(
        self,
        link: MavlinkLink,
        identifier: int,
        home: Position,
        *,
        speedup: float,
        timeout_s: float,
        parameters: Mapping[str, float] | None = None,
    ) -> StreamConnection:
        """Start an autopilot and connect it to a link. The link is lost when the autopilot ends.

        Raise SitlError if it does not start, or does not connect within `timeout_s` of wall time. The other
        arguments are those of `start`.
        """
        connection = StreamConnection(link)
        # The autopilot connects to us, so its port need not be known and no other program can interfere.
        server = await asyncio.get_running_loop().create_server(connection.accept, "127.0.0.1", 0)
        try:
            process = self.start(
                link.name,
                identifier,
                home,
                mavlink_port=server.sockets[0].getsockname()[1],
                speedup=speedup,
                parameters=parameters,
            )
            connection.explain = process.exit_report
            link.last_output = process.last_output
            await _connected(connection, process, timeout_s)
        except BaseException:
            connection.close()
            raise
        finally:
            server.close()
        return connection

    def start(
        self,
        name: str,
        identifier: int,
        home: Position,
        *,
        mavlink_port: int,
        speedup: float = 1.0,
        physics_port: int | None = None,
        parameters: Mapping[str, float] | None = None,
    ) -> AutopilotProcess:
        """Start an autopilot that connects to `mavlink_port`, a TCP port of 127.0.0.1, or raise SitlError.

        Its MAVLink system id is `identifier` modulo 255, plus 1. Its home (latitude deg, longitude deg,
        altitude m) is on the ground. `physics_port` is a UDP port for external physics; without one it has
        ArduPilot's own, at `speedup` seconds of its clock per second of wall time. `parameters` are further
        ones of ArduCopter.
        """
        folder = self._folder / str(identifier)
        folder.mkdir()
        if self._user is not None:
            shutil.chown(folder, self._user)
        file = folder / "defaults.parm"
        system_id = identifier % 255 + 1
        help_text = self._help_text(name)
        file.write_text(parameter_file(system_id=system_id, help_text=help_text, more=parameters or {}))
        file.chmod(0o644)
        console = (self._consoles or self._folder) / f"autopilot_{identifier}.log"
        instance = free_instance(self._instances)
        self._instances.add(instance)
        arguments = options(
            home=home,
            speedup=speedup,
            parameters=Path(file.name),  # A relative path, because a comma in the path would make it a list.
            instance=instance,
            port=mavlink_port,
            physics_port=physics_port,
            system_id=system_id,
            help_text=help_text,
        )
        process = AutopilotProcess(
            name, command_as(self._user, [str(self._program), *arguments]), folder, console
        )
        self._processes.append(process)
        return process

    def close(self) -> None:
        """End all autopilots and remove their files. Do nothing if that has been done."""
        self._end()

    def _reachable(self, program: Path) -> Path:
        """Return a program that the user can read: a copy if the user is not this one."""
        if self._user is None:
            return program
        self._folder.chmod(0o711)
        copy = self._folder / "autopilot"
        shutil.copyfile(program, copy)
        copy.chmod(0o755)
        return copy

    def _help_text(self, name: str) -> str:
        """Return the output of the program for --help. `name` is that of a vehicle, for messages."""
        if self._help is None:
            console = self._folder / "help.log"
            command = command_as(self._user, [str(self._program), "--help"])
            process = AutopilotProcess(name, command, self._folder, console)
            self._processes.append(process)  # On Ctrl-C it ends with the others.
            if not process.wait_until(time.monotonic() + _HELP_S):
                process.send(signal.SIGKILL)
                process.wait_until(time.monotonic() + GRACE_S)
                raise SitlError(f"{name}: start: {self._found} did not answer --help within {_HELP_S:g} s")
            self._help = console.read_text(errors="replace")
        return self._help


async def _connected(connection: StreamConnection, process: AutopilotProcess, timeout_s: float) -> None:
    """Wait for the connection while the process runs."""
    loop = asyncio.get_running_loop()
    deadline = loop.time() + timeout_s
    while not connection.made.is_set():
        if not process.is_running:
            raise SitlError(f"{process.name}: start: {process.exit_report()}")
        if loop.time() > deadline:
            raise SitlError(f"{process.name}: start: it did not connect within {timeout_s:g} s")
        await asyncio.sleep(0.02)


def _end(processes: list[AutopilotProcess], files: FleetDirectory, grace_s: float) -> None:
    stop_all(processes, grace_s)
    files.remove()
