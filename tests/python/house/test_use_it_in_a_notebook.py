"""docs/how-to/use-it-in-a-notebook.ipynb runs, and shows what its text says."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")
nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")

NOTEBOOK = "docs/how-to/use-it-in-a-notebook.ipynb"


@pytest.fixture(scope="module")
def shown(tmp_path_factory: pytest.TempPathFactory) -> Mapping[str, list[Any]]:
    """Return {source of a cell: its outputs} of the executed notebook."""
    root, folder = Path(__file__).parents[3], tmp_path_factory.mktemp("notebook")
    notebook = nbformat.read(root / NOTEBOOK, as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "it is stored without outputs"
    variables = {**os.environ, "PYTHONPATH": str(root / "python"), "IPYTHONDIR": str(folder / "ipython")}
    client = nbclient.NotebookClient(notebook, resources={"metadata": {"path": str(folder)}})
    client.execute(env=variables)
    return {cell.source: cell.outputs for cell in notebook.cells if cell.cell_type == "code"}


def value(shown: Mapping[str, list[Any]], source: str) -> Mapping[str, str]:
    """Return the value of a cell that ends with `source`, by type of content."""
    (outputs,) = (outputs for text, outputs in shown.items() if text.endswith(source))
    data: Mapping[str, str] = outputs[-1].data
    return data


def test_each_sensor_hears_the_others_in_prototype_mode(shown: Mapping[str, list[Any]]) -> None:
    table = value(shown, 'gs.run("hello.ini", mode="prototype")')["text/html"]
    assert table.count("<td>180</td>") == 4


def test_nobody_hears_anything_in_integrated_mode(shown: Mapping[str, list[Any]]) -> None:
    assert value(shown, "result")["text/html"].count("<td>0</td>") == 4


def test_the_replay_is_a_frame_of_0_85_mb(shown: Mapping[str, list[Any]]) -> None:
    frame = value(shown, "result.view()")["text/html"]
    assert frame.startswith("<iframe")
    assert len(frame) / 1e6 == pytest.approx(0.85, abs=0.05)


def test_the_runs_are_listed(shown: Mapping[str, list[Any]]) -> None:
    assert "<td>100us</td>" in value(shown, 'runs="0..11")')["text/html"]


def test_a_study_has_a_bar_and_a_table_of_means(shown: Mapping[str, list[Any]]) -> None:
    (outputs,) = (outputs for text, outputs in shown.items() if text.startswith("study = "))
    bar, table = outputs
    assert "40 of 40 runs" in bar.data["text/html"]
    assert "<td>sensors[*] heard</td>" in table.data["text/html"]


def test_a_millisecond_saves_most_greetings(shown: Mapping[str, list[Any]]) -> None:
    heard = [
        float(text) for text in value(shown, '["sensors[*] heard"]')["text/plain"].strip("[]").split(",")
    ]
    assert len(heard) == 10
    assert min(heard) > 90


def test_the_figure_is_a_picture(shown: Mapping[str, list[Any]]) -> None:
    assert "image/png" in value(shown, "figure")


def test_no_cell_prints_a_warning(shown: Mapping[str, list[Any]]) -> None:
    streams = {
        output.text for outputs in shown.values() for output in outputs if output.output_type == "stream"
    }
    assert streams == {"Writing hello.py\n", "Writing hello.ini\n"}
