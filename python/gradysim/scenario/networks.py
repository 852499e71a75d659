"""The networks of all runs: those that are alike are read once, and what no run reads is found."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from gradysim.scenario.distributions import distribution_in
from gradysim.scenario.errors.source import Source
from gradysim.scenario.file.reader import Entry
from gradysim.scenario.file.sections import Ranked
from gradysim.scenario.matching.key_check import NoSuchNodeError
from gradysim.scenario.matching.lookup import is_ignored, is_option
from gradysim.scenario.network import Network, read_network
from gradysim.scenario.protocols import ProtocolLoader
from gradysim.scenario.runs import FileHashes, UnreadVariables, line_instead, unread_variables
from gradysim.scenario.settings import SettingReader
from gradysim.scenario.sweep import IterationVariable, depends_on_run, substitute, substituted


class _Read(NamedTuple):
    """A network, what it was made of, and what has read it."""

    texts: list[str]
    seed: int
    network: Network
    settings: SettingReader


class Networks:
    """Reads the network of one run after the other."""

    def __init__(self, ranked: Sequence[Ranked], folder: Path, instead: str, source: Source) -> None:
        """Begin with the first run.

        Args:
            ranked: The entries of the configuration, with names for the values of a run.
            folder: That of the .ini file.
            instead: What messages about nodes that are not there end in.
            source: The place of the configuration.
        """
        self._ranked = ranked
        self._instead = instead
        self._source = source
        self._loader, self._hashes = ProtocolLoader(), FileHashes(folder)
        parameters = [entry for _, entry in ranked if not is_option(entry) and not is_ignored(entry)]
        self._varying = [entry for entry in parameters if depends_on_run(entry)]
        self._always_draws = any(distribution_in(entry.text) for entry in parameters)
        self._last: _Read | None = None
        self._of_other_runs: list[Sequence[Source]] = []
        self._read: set[Source] = set()

    def of_run(self, variables: Mapping[str, str], seed: int) -> Network:
        """Return the network of a run: that of the run before if what it is made of is the same.

        Raises ConfigError for anything that is wrong.
        """
        network, is_its_own = self.checked(variables, seed)
        return network if is_its_own else self._read_network(self._texts(variables), variables, seed)

    def checked(self, variables: Mapping[str, str], seed: int) -> tuple[Network, bool]:
        """Return the network of a run, or one of another seed if nothing is wrong with both or with neither.

        And whether it is the first. Raises ConfigError for anything that is wrong.
        """
        texts, last = self._texts(variables), self._last
        if last is None or texts != last.texts:
            return self._read_network(texts, variables, seed), True
        if seed == last.seed or not (self._always_draws or any(map(distribution_in, texts))):
            return last.network, True
        if last.settings.is_right_for_all_seeds():
            return last.network, False
        return self._read_network(texts, variables, seed), True

    def _texts(self, variables: Mapping[str, str]) -> list[str]:
        """What networks differ by, but for what they draw."""
        return [substitute(entry, variables).text for entry in self._varying]

    def _read_network(self, texts: list[str], variables: Mapping[str, str], seed: int) -> Network:
        settings = SettingReader(seed)
        entries = substituted(self._ranked, variables)
        network = read_network(entries, settings, self._loader, self._hashes, self._instead, self._source)
        self._of_other_runs.append(network.lines_of_other_runs)
        self._read |= settings.lines_read()
        self._last = _Read(texts, seed, network, settings)
        return network

    def check_lines_of_other_runs(self) -> None:
        """Raise NoSuchNodeError for the first line that each of the runs leaves to others."""
        first, *others = self._of_other_runs
        for line in first:
            if all(line in lines for lines in others):
                raise NoSuchNodeError(
                    f"`{line.key}` matches no node in any run; expected a node that some run has", line
                )

    def unread(
        self, lines: Sequence[Entry], variables: Sequence[IterationVariable]
    ) -> tuple[UnreadVariables, ...]:
        """Return which of the variables, of these lines of the configuration, no run up to now has read."""
        assert self._last is not None
        network, settings = self._last.network, self._last.settings
        nodes, parameters = [spec.name for spec in network.nodes], settings.parameters_read()
        return tuple(
            UnreadVariables(line, names, line_instead(line, network.lookup, nodes, parameters))
            for line, names in unread_variables(lines, variables, self._read).items()
        )
