"""Plugin that writes the pace of the simulation and the tracked variables of a node to CSV files."""

import csv
import os
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from gradysim.protocol.checked_values import checked_number
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.plugin.dispatcher import DispatchReturn, create_dispatcher

DATA_COLLECTION_INTERVAL = 0.1
"""Default time between two samples, s."""

_TIMER = "statistics"
_ATTRIBUTE = "_gradysim_statistics"
_PLAIN = (bool, int, float, str, type(None))

_Row = tuple[float, dict[str, Any]]
"""Time in the simulation, s, and values by the names of their columns."""


class StatisticsProtocolWrapper:
    """The samples of one protocol; made by `create_statistics`, written by `finish_statistics`.

    While it collects, the timer "statistics" is its own: timers of that name do not reach the protocol.
    """

    def __init__(
        self, protocol: IProtocol, file_name_part: str, collection_interval: float = DATA_COLLECTION_INTERVAL
    ) -> None:
        """Prepare to sample `protocol`; the arguments are those of `create_statistics`."""
        self.protocol = protocol
        self.configure(file_name_part, collection_interval)
        self._registered = False
        self._times: list[_Row] = []
        self._tracked: list[_Row] = []

    def configure(self, file_name_part: str, collection_interval: float) -> None:
        """Change the name of the files, and the interval from the next sample on."""
        if not isinstance(file_name_part, str) or set(file_name_part) & {"/", "\\", os.sep, "\0"}:
            raise ValueError(
                f"file_name_part must be a part of a file's name, without folders, got {file_name_part!r}"
            )
        self._file_name_part = file_name_part
        self._interval = checked_number("collection_interval", collection_interval, 0, above=True, unit="s")

    def register(self) -> None:
        """Start to sample: one interval from now, and then every interval. No-op if it has started."""
        if self._registered:
            return
        self._registered = True
        protocol = self.protocol
        create_dispatcher(protocol).register_handle_timer(self._handle_timer)
        # Around the dispatcher, to sample after the protocol has handled the packet.
        self._dispatch_packet: Callable[[str], None] = protocol.handle_packet
        vars(protocol)["handle_packet"] = self._handle_packet
        self._schedule()

    def unregister(self) -> None:
        """Stop to sample; the protocol is as it was before. No-op if it has stopped."""
        if not self._registered:
            return
        self._registered = False
        protocol = self.protocol
        protocol.provider.cancel_timer(_TIMER)
        create_dispatcher(protocol).unregister_handle_timer(self._handle_timer)
        # A function that has replaced it since still calls this one, which passes the packet on.
        if vars(protocol)["handle_packet"] == self._handle_packet:
            vars(protocol)["handle_packet"] = self._dispatch_packet

    def update_srt_statistic(self, simulation_time: float, real_time: float) -> None:
        """Add a row: time in the simulation, s, and time of the wall clock, s since 1970."""
        self._times.append((simulation_time, {"real_time": real_time}))

    def update_tracked_variable_statistic(
        self, simulation_time: float, tracked_variables: Mapping[str, Any]
    ) -> None:
        """Add a row: time in the simulation, s, and the values that the variables have now."""
        values = {
            name: value if isinstance(value, _PLAIN) else str(value)  # as it is now: lists may change later
            for name, value in tracked_variables.items()
        }
        self._tracked.append((simulation_time, values))

    def create_statistic_files(self) -> None:
        """Write both files to the working directory; files of these names are replaced."""
        protocol = self.protocol
        names = (self._file_name_part, type(protocol).__name__, str(protocol.provider.get_id()))
        run = getattr(protocol.provider, "run_name", "")  # users' own providers may be older, or mocks
        suffix = "_".join((run, *names) if run and isinstance(run, str) else names) + ".csv"
        _write(f"simulation_real_time_{suffix}", ["real_time"], self._times)
        names_of_all = dict.fromkeys(name for _, values in self._tracked for name in values)
        _write(f"tracked_variables_{suffix}", list(names_of_all), self._tracked)

    def _schedule(self) -> None:
        provider = self.protocol.provider
        provider.schedule_timer(_TIMER, provider.current_time() + self._interval)

    def _handle_timer(self, _protocol: IProtocol, timer: str) -> DispatchReturn:
        if timer != _TIMER:
            return DispatchReturn.CONTINUE
        self.update_srt_statistic(self.protocol.provider.current_time(), time.time())
        self._sample_tracked_variables()
        self._schedule()
        return DispatchReturn.INTERRUPT

    def _handle_packet(self, message: str) -> None:
        self._dispatch_packet(message)
        if self._registered:
            self._sample_tracked_variables()

    def _sample_tracked_variables(self) -> None:
        provider = self.protocol.provider
        self.update_tracked_variable_statistic(provider.current_time(), provider.tracked_variables)


def create_statistics(
    protocol: IProtocol, file_name_part: str = "", collection_interval: float = DATA_COLLECTION_INTERVAL
) -> StatisticsProtocolWrapper:
    """Start to collect statistics of a protocol; call it in `initialize` or later.

    Every `collection_interval` (s, > 0) the simulated and the wall clock's time are sampled, and with them
    the tracked variables; these also after each packet that the node has handled. Values that are not
    numbers, texts or truth values are kept as the text that they print. `finish_statistics` writes the files,
    with `file_name_part` in their names. While a collector is at work, calling again changes both settings,
    and returns the same one. ValueError if one of them is not valid.
    """
    create_dispatcher(protocol)  # raises TypeError for anything but a protocol
    wrapper: StatisticsProtocolWrapper | None = vars(protocol).get(_ATTRIBUTE)
    if wrapper is None:
        wrapper = StatisticsProtocolWrapper(protocol, file_name_part, collection_interval)
        vars(protocol)[_ATTRIBUTE] = wrapper
    else:
        wrapper.configure(file_name_part, collection_interval)
    wrapper.register()
    return wrapper


def finish_statistics(protocol: IProtocol) -> None:
    """Stop to collect, and write two files to the working directory; call it in `finish` at the latest.

    Their first column numbers the rows, from 0. NAME is `file_name_part`, then the class of the protocol and
    the id of its node, joined with underscores. If the run is one of several of a configuration, all this
    comes after its name, as in `tracked_variables_Study-#3.integrated_NAME.csv`: runs do not overwrite the
    files of each other.

    - `simulation_real_time_NAME.csv`: simulation_time (s), real_time (s since 1970)
    - `tracked_variables_NAME.csv`: simulation_time (s), then a column for each variable, in the order of
      their appearance; empty where a variable was not there

    Raises:
        ValueError: No statistics of this protocol are being collected.
        OSError: A file cannot be written.
    """
    wrapper: StatisticsProtocolWrapper | None = vars(protocol).pop(_ATTRIBUTE, None)
    if wrapper is None:
        raise ValueError(f"no statistics of {protocol!r} are being collected: call create_statistics before")
    wrapper.unregister()
    wrapper.create_statistic_files()


def _write(path: str, columns: Sequence[str], rows: Sequence[_Row]) -> None:
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["", "simulation_time", *columns])
        for index, (simulation_time, values) in enumerate(rows):
            writer.writerow([index, simulation_time, *(values.get(column) for column in columns)])
