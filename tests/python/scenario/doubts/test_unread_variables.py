from typing import Any

from gradysim.scenario import load_scenarios
from gradysim.scenario.doubts.unread_variables import unread_variables
from python.scenario.conftest import BASE

RTS = "**.rtsThreshold = ${rts=3000B, 100B}\n"
EXPECTED = "; expected an override with the very same key, which makes no such runs"


def told(folder: Any, added: str, *overrides: str, config: str = "General") -> str:
    """The only text for the base with some lines more, the folder left out."""
    folder.write("test.ini", BASE + added)
    scenario = load_scenarios(folder.ini, config, overrides=overrides)[-1]
    (text,) = unread_variables(scenario.unread_variables, scenario.lines)
    return text.replace(f"{folder.path}/", "")


def test_a_study_that_another_key_overrides_is_told_with_the_line_in_force(folder: Any) -> None:
    override = "**.mac.dcf.rtsPolicy.rtsThreshold=100B"
    assert told(folder, RTS, override) == (
        "test.ini:6: warning: no run reads `**.rtsThreshold`, and runs that differ in $rts alone are alike:"
        f" `override {override}` is in force{EXPECTED}"
    )


def test_a_line_of_the_same_file_is_told_with_its_number(folder: Any) -> None:
    sections = '[Base]\n*.numBoats = ${boats=4, 8}\n*.boats[*].protocol.class = "protocols.py:Sensor"\n'
    assert told(folder, f"{sections}[Own]\nextends = Base\n*.boats.count = 2\n", config="Own") == (
        "test.ini:7: warning: no run reads `*.numBoats`, and runs that differ in $boats alone are alike: line"
        f" 11, `*.boats.count`, is in force{EXPECTED}"
    )


def test_a_key_that_says_the_same_in_other_words_is_found(folder: Any) -> None:
    study = "*.uavs[*].mobility.initialX = ${1m, 2m}\n"
    text = told(folder, study, "**.mobility.lineStartX=5m")
    assert "$0 alone are alike: `override **.mobility.lineStartX=5m` is in force; " in text


def test_of_nodes_that_are_not_there_no_other_line_is_in_force(folder: Any) -> None:
    boats = '*.numBoats = 0\n*.boats[*].protocol.class = "protocols.py:Sensor"\n'
    text = told(folder, f"{boats}*.boats[*].mobility.speed = ${{one=1, 2}}mps * ${{other=1, 2}}\n")
    assert text.endswith("differ in $one and $other alone are alike; expected a line that some run reads")
