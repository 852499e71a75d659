"""A directory of results as a state machine: no command makes a complete result less, unless it is asked to.

`--replace` is what asks for it. Commands are disturbed at random by faults of the disk, kills, signals and
power failures.
"""

import shutil
import tempfile
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import hypothesis
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, rule, run_state_machine_as_test

from gradysim.cli.errors import MISTAKE, OK
from gradysim.results.files import bytes_of, is_run_file
from gradysim.results.result_dir import result_names
from gradysim.scenario.resolve.runs import hash_of
from python.torture.bad_disk import FAULTS, POWER, SIGNALS, BadDisk
from python.torture.study import OUT, content_of_result, prepare

Results = dict[str, dict[str, Any]]

_RUN = ("run", "study.ini", "--quiet", "--result-dir", OUT, "--pcap", "nodes[0]")
_LIMITS = ("2s", "3s")
_RUNS = ("0", "2", "0,2")
_HOW = ((), ("--resume",), ("--replace",), ("--resume", "--replace"))
_PROTOCOL = """
import contextlib

class Looks(Talker):
    def handle_timer(self, timer):
        with contextlib.suppress(OSError):
            open("out/missing")
        super().handle_timer(timer)
"""
"""Looks at the disk, so that a run is disturbed in its middle, too."""

_AT_ONCE = 3
_MOST_CALLS = 80
"""About as many as a command makes."""

Disturbance = tuple[str, int, bool]
"""Fault or "", number of the call, and whether all names are there after a power failure."""


def _disturbance(number: int) -> Disturbance:
    random = Random(number)  # Hypothesis prefers the first calls, which matter least
    fault = random.choice([random.choice(FAULTS), random.choice([*SIGNALS, ""])]) if number else ""
    return fault, random.randint(1, _MOST_CALLS), random.random() < 0.5


_DISTURBED = st.integers(0, 2**32).map(_disturbance)


class ResultDirectory(RuleBasedStateMachine):
    """Commands in a directory, whose results are known.

    Attributes:
        disk: Runs the commands of all machines.
    """

    disk: BadDisk

    def __init__(self) -> None:
        """Make an empty directory of results."""
        super().__init__()
        self._folder = Path(tempfile.mkdtemp())
        (self._folder / OUT).mkdir()
        _prepare(self._folder)
        self._known: Results = {}

    def teardown(self) -> None:
        """Remove the directory."""
        shutil.rmtree(self._folder)

    @rule(
        limit=st.sampled_from(_LIMITS),
        runs=st.sampled_from(_RUNS),
        how=st.sampled_from(_HOW),
        disturbed=_DISTURBED,
    )
    def run(self, limit: str, runs: str, how: tuple[str, ...], disturbed: Disturbance) -> None:
        """Run some runs. Without --replace, results of other settings are refused."""
        wanted = {name: undisturbed()[limit][name] for name in map(_name_of, runs.split(","))}
        is_refused = "--replace" not in how and any(
            name in self._known and self._known[name]["settings_hash"] != wanted[name]["settings_hash"]
            for name in wanted
        )
        before = self._known
        code = self._do(
            (*_RUN, *_limited(limit), "-r", runs, *how), disturbed, may_replace="--replace" in how
        )
        if is_refused:
            assert self._known == before
        if not disturbed[0]:
            assert code == (MISTAKE if is_refused else OK)
            assert is_refused or wanted.items() <= self._known.items()

    @rule(remove=st.booleans(), disturbed=_DISTURBED)
    def pack(self, remove: bool, disturbed: Disturbance) -> None:
        """Pack all results."""
        code = self._do(("pack", OUT, *(("--remove",) if remove else ())), disturbed)
        assert code == OK or disturbed[0] or not self._known

    @rule(remove=st.booleans(), disturbed=_DISTURBED)
    def unpack(self, remove: bool, disturbed: Disturbance) -> None:
        """Unpack all packs."""
        has_packs = (self._folder / OUT / "packs").exists()
        code = self._do(("pack", OUT, "--unpack", *(("--remove",) if remove else ())), disturbed)
        assert code == OK or disturbed[0] or not has_packs

    def _do(self, command: tuple[str, ...], disturbed: Disturbance, *, may_replace: bool = False) -> int:
        """Execute a command, and return its exit code. Fails if a complete result is less than before."""
        fault, at, has_all_names = disturbed
        done = self.disk.run(self._folder, command, fault, at)
        assert "Traceback" not in done.error_output, done
        if fault == POWER:
            for number, _ in enumerate(self.disk.after_power_failure(self._folder)):
                if number == has_all_names:
                    break
        before, self._known = self._known, self._results()
        for name, result in before.items():
            if not result["interrupted"]:
                self._check_kept(name, result, may_replace=may_replace)
        verified = self.disk.run(self._folder, ("verify", OUT))
        assert verified.code == (OK if self._known else MISTAKE), (done, verified.output)
        return done.code

    def _check_kept(self, name: str, before: dict[str, Any], *, may_replace: bool) -> None:
        after = self._known[name]
        assert not after["interrupted"], name
        if not may_replace:
            assert {**after, "output_hashes": {}} == {**before, "output_hashes": {}}
            for file, known_hash in before["output_hashes"].items():
                assert hash_of(self._folder / OUT / file) == known_hash, file

    def _results(self) -> Results:
        """Return the results in the directory and in its packs. Each complete one is as undisturbed."""
        directory = self._folder / OUT
        found = {name: content_of_result(bytes_of(directory / name)) for name in result_names(directory)}
        for name, result in found.items():
            assert is_run_file(name)
            expected = [undisturbed()[limit][name] for limit in _LIMITS]
            if not result["interrupted"]:
                assert result in [*expected, *({**each, "output_hashes": {}} for each in expected)], name
        return found


def _name_of(run: str) -> str:
    return f"General-#{run}.integrated.json"


def _prepare(folder: Path) -> None:
    prepare(folder)
    with (folder / "talker.py").open("a") as file:
        file.write(_PROTOCOL)


def _limited(limit: str) -> tuple[str, ...]:
    return "--set", f"sim-time-limit={limit}", "--set", '*.nodes[*].protocol.class="talker.py:Looks"'


@cache
def undisturbed() -> dict[str, Results]:
    """Return the undisturbed results for each time limit."""
    found = {}
    for limit in _LIMITS:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            _prepare(folder)
            assert ResultDirectory.disk.run(folder, (*_RUN, *_limited(limit), "-r", "0,2")).code == OK
            found[limit] = {
                file.name: content_of_result(file.read_bytes()) for file in (folder / OUT).glob("*.json")
            }
    return found


def once(random: Random, folder: Path) -> int:
    """Check some sequences of commands; return how many."""
    with BadDisk(OUT) as ResultDirectory.disk:
        run_state_machine_as_test(  # type: ignore[no-untyped-call]
            hypothesis.seed(random.randrange(2**32))(ResultDirectory),
            settings=settings(
                max_examples=_AT_ONCE,
                stateful_step_count=8,
                database=None,
                deadline=None,
                suppress_health_check=list(HealthCheck),
            ),
        )
    return _AT_ONCE
