"""The files that a run of `gradysim run` leaves behind."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from gradysim.cli.arguments import Mode
from gradysim.cli.asked import Asked
from gradysim.cli.files_of_run import files_beside_result, omnetpp_file
from gradysim.cli.simulators import capture_files_of

if TYPE_CHECKING:
    from gradysim.results.result import RunResult
    from gradysim.scenario.scenario import Scenario


def write_files(scenario: "Scenario", result: "RunResult", asked: Asked) -> Iterator[str]:
    """Write what was asked for of a run, and give a line about each file.

    Captures are there already: radios write them. Files for OMNeT++ that an earlier run left under names of
    this one are removed first, also those that it replaces, if there is room for them. Raises OSError, with
    the name of the file.

    The result comes first: it is there if the disk has no room for the others. Once they are complete it is
    written again, and names them.
    """
    from gradysim.results.files import write_run_file

    if asked.writes_files:
        yield from _remove_of_earlier_runs(scenario, result.mode, asked)
    if asked.result_dir is not None:
        yield f"written to {write_run_file(result, asked.result_dir)}"
    if asked.scalars or asked.vectors:
        yield from _write_for_omnetpp(scenario, result, asked)
    for capture in capture_files_of(scenario, asked):
        yield f"captured in {capture}"
    if asked.result_dir is not None and (others := files_beside_result(scenario, result.mode, asked)):
        write_run_file(result, asked.result_dir, others)


def _remove_of_earlier_runs(scenario: "Scenario", mode: Mode, asked: Asked) -> Iterator[str]:
    """Remove what a reader would take for scalars or vectors of this run, and are those of another one."""
    for suffix, is_replaced in ((".sca", asked.scalars), (".vec", bool(asked.vectors))):
        path = omnetpp_file(scenario, mode, asked, suffix)
        if path.is_file():
            path.unlink()
            if not is_replaced:
                yield f"removed {path}, of an earlier run"


def _write_for_omnetpp(scenario: "Scenario", result: "RunResult", asked: Asked) -> Iterator[str]:
    from gradysim.results.omnetpp import identity_of, vectors_of, write_scalar_file, write_vector_file

    identity = identity_of(result, scenario, asked.directory)
    if asked.scalars:
        path = omnetpp_file(scenario, result.mode, asked, ".sca")
        network = scenario.network
        write_scalar_file(result.scalars(network), identity, path, result.histograms(network))
        yield f"scalars in {path}"
    if asked.vectors:
        path = omnetpp_file(scenario, result.mode, asked, ".vec")
        write_vector_file(vectors_of(result, scenario.network), identity, path)
        yield f"vectors in {path}"
