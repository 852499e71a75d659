"""What docs/how-to/use-handlers.md shows is what happens."""

import importlib
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.scenario import load_scenarios
from gradysim.simulator.handler.assertion import FailedAssertionException

pytest.importorskip("gradysim._netsim")


@pytest.fixture
def text(root: Path) -> str:
    return (root / "docs/how-to/use-handlers.md").read_text()


@pytest.fixture
def folder(text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder with the guide's files, as a reader would save them; it is the working directory."""
    programs = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    (tmp_path / "climber.py").write_text(programs[0])
    (tmp_path / "watch.py").write_text("\n\n".join(programs[1:]))
    (ini,) = re.findall(r"^```ini\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    (tmp_path / "watch.ini").write_text(ini)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def watch(folder: Path, imported: Callable[[Path], Any]) -> Any:
    """The guide's script, imported."""
    return imported(folder / "watch.py")


def test_the_checks_hold_in_both_modes(watch: Any) -> None:
    assert [result.mode for result in watch.check("watch.ini")] == ["prototype", "integrated"]


@pytest.mark.parametrize("mode", ["prototype", "integrated"])
def test_a_check_fails_in_the_words_of_the_guide(watch: Any, mode: str, text: str) -> None:
    (shown,) = re.findall(r"^```text\n(.*)\n```", text, re.MULTILINE)
    (change,) = re.findall(r"With `(.*)` in `watch.ini`", text)
    words = re.escape(shown)
    if mode == "integrated":  # other iterations, as the guide says
        words = re.sub(r"iteration=\d+", r"iteration=\\d+", words)
    module: Any = importlib.import_module(f"gradysim.{mode}.run")
    (scenario,) = load_scenarios("watch.ini", overrides=[change])
    with pytest.raises(FailedAssertionException, match=f"^{words}$"):
        module.run(scenario, handlers=[watch.AssertionHandler([watch.below_the_ceiling])])


def test_a_protocol_that_is_loaded_twice_is_an_error(watch: Any) -> None:
    ini = Path("watch.ini")
    ini.write_text(ini.read_text().replace("climber:", "climber.py:"))
    with pytest.raises(TypeError, match=r'loaded twice.* "climber:Climber"'):
        watch.check("watch.ini")


def test_it_is_shown_in_real_time(watch: Any, wall_clock: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    configuration = watch.VisualizationConfiguration
    monkeypatch.setattr(
        watch, "VisualizationConfiguration", lambda **settings: configuration(port=0, **settings)
    )
    started = wall_clock.now
    assert watch.show("watch.ini").sim_time_s == 10
    assert wall_clock.now - started == pytest.approx(10)


def test_heights_once_a_second(watch: Any) -> None:
    samples = watch.heights("watch.ini")
    assert [time for time, _ in samples] == pytest.approx(range(1, 11))
    for time, heights in samples:
        assert heights == pytest.approx([min(10 * time, 50)] * 3, abs=0.01)


def test_each_message_with_when_and_who_got_it(watch: Any) -> None:
    rows = watch.messages("watch.ini")
    assert sorted(node for _, node, _ in rows) == [0, 0, 1, 1, 2, 2]
    assert all(2 < time < 3.1 and message == "climbing" for time, _, message in rows)


def test_careful_climbers_are_on_the_ground_in_both_modes(watch: Any) -> None:
    assert watch.heights_at_the_end("watch.ini") == pytest.approx([0] * 6, abs=0.01)


def test_careful_climbers_stay_up_as_long_as_their_batteries_are_full(
    watch: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(watch.Battery, "drain", lambda battery: None)
    assert watch.heights_at_the_end("watch.ini") == pytest.approx([50] * 6, abs=0.01)


def test_its_types_hold(folder: Path, type_errors: Callable[[Path], str]) -> None:
    assert type_errors(folder / "watch.py") == ""
