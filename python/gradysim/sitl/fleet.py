"""Simulated autopilots of one simulation: started with what they need, and gone with it."""

import asyncio
import os
import shutil
import signal
import time
import weakref
from collections.abc import Mapping
from pathlib import Path

from gradysim.protocol.position import Position
from gradysim.sitl.arducopter import find_arducopter, options, parameter_file
from gradysim.sitl.connection import StreamConnection
from gradysim.sitl.error import SitlError
from gradysim.sitl.folder import FleetFolder
from gradysim.sitl.instance import free_instance
from gradysim.sitl.link import MavlinkLink
from gradysim.sitl.process import GRACE_S, AutopilotProcess, stop_all
from gradysim.sitl.unprivileged import DEFAULT_USER, command_as, user_for

_HELP_S = 10.0
"""Wall time in which a program answers to --help."""


class Fleet:
    """Starts autopilots, each with a folder of its own, and ends them.

    `close` ends all and removes their files. Should it never be called, that happens when the fleet is
    dropped, or Python ends; if Python is killed, when the next fleet starts.
    """

    def __init__(
        self,
        program: str | os.PathLike[str] | None,
        *,
        user: str | None = DEFAULT_USER,
        console_folder: str | os.PathLike[str] | None = None,
        grace_s: float = GRACE_S,
    ) -> None:
        """Find the program and prepare a folder.

        Args:
            program: See `find_arducopter`.
            user: Whom autopilots that root starts belong to; None for root.
            console_folder: Keeps what each autopilot prints, `autopilot_<id>.log`; None to throw it away.
            grace_s: Wall time in which autopilots may end by themselves; one that waits for physics cannot.

        Raises:
            SitlError: The program cannot be run so.
        """
        self._found = find_arducopter(program)
        self._user = user_for(user)
        self._consoles = None if console_folder is None else Path(console_folder).expanduser().absolute()
        if self._consoles is not None:
            self._consoles.mkdir(parents=True, exist_ok=True)
        files = FleetFolder()
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
        """Start an autopilot and join it with a link; the link is lost when the autopilot ends.

        Args:
            link: Without a connection so far.
            identifier: Names its files; its MAVLink system id is one more, up to 255 and then from 1 again.
            home: Where it stands: (latitude deg, longitude deg, altitude m).
            speedup: Seconds of its clock for each wall second.
            timeout_s: Wall time until it connects.
            parameters: More of ArduCopter's, by name.

        Raises:
            SitlError: It does not start, or does not connect.
        """
        connection = StreamConnection(link)
        # The autopilot comes to us: nobody else can get in between, and no port has to be guessed.
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
            connection.explain = process.obituary
            link.last_words = process.last_words
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
        """Start an autopilot that connects to us.

        Args:
            name: Of the vehicle, for people.
            identifier: As for `launch`; so are `home`, `speedup` and `parameters`.
            home: Where it stands.
            mavlink_port: TCP port of 127.0.0.1 that listens already.
            speedup: Not used with physics of ours.
            physics_port: UDP port of 127.0.0.1 where physics of ours listen; None for ArduPilot's own.
            parameters: More of ArduCopter's, by name.

        Raises:
            SitlError: It does not start.
        """
        folder = self._folder / str(identifier)
        folder.mkdir()
        self._hand_over(folder)
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
            parameters=Path(file.name),  # A list to it if there is a comma, as the folder's path may have.
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
        """End all autopilots and remove their files; no-op if that has happened."""
        self._end()

    def _reachable(self, program: Path) -> Path:
        """Return a program that the user can read, whatever folder the given one is in."""
        if self._user is None:
            return program
        self._folder.chmod(0o711)
        copy = self._folder / "autopilot"
        shutil.copyfile(program, copy)
        copy.chmod(0o755)
        return copy

    def _hand_over(self, path: Path) -> None:
        if self._user is not None:
            shutil.chown(path, self._user)

    def _help_text(self, name: str) -> str:
        """Return what the program answers to --help; it is asked once. `name` is of a vehicle, for people."""
        if self._help is None:
            console = self._folder / "help.log"
            command = command_as(self._user, [str(self._program), "--help"])
            process = AutopilotProcess(name, command, self._folder, console)
            self._processes.append(process)  # It ends with the others if Ctrl-C comes meanwhile.
            if not process.wait_until(time.monotonic() + _HELP_S):
                process.send(signal.SIGKILL)
                process.wait_until(time.monotonic() + GRACE_S)
                raise SitlError(f"{name}: start: {self._found} did not answer to --help in {_HELP_S:g} s")
            self._help = console.read_text(errors="replace")
        return self._help


async def _connected(connection: StreamConnection, process: AutopilotProcess, timeout_s: float) -> None:
    """Wait for the connection, and no longer than the process lives."""
    loop = asyncio.get_running_loop()
    deadline = loop.time() + timeout_s
    while not connection.made.is_set():
        if not process.is_running:
            raise SitlError(f"{process.name}: start: {process.obituary()}")
        if loop.time() > deadline:
            raise SitlError(f"{process.name}: start: it did not connect in {timeout_s:g} s")
        await asyncio.sleep(0.02)


def _end(processes: list[AutopilotProcess], files: FleetFolder, grace_s: float) -> None:
    stop_all(processes, grace_s)
    files.remove()
