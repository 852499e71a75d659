import dataclasses
import re
from pathlib import Path

import pytest

from gradysim.prototype.run import run
from gradysim.results.omnetpp import identity_of, lasting_attributes
from gradysim.scenario import load_scenarios

STUDY = ("repeat = 2", "**.heard = ${y=5, 6}", "**.mobility.speed = ${x=1, 2}mps", "sim-time-limit = ${0.5s}")


@pytest.fixture
def identity(make_scenario):
    """`identity(*settings)`: attributes of the fourth run of a study."""
    base = make_scenario("class Tested(Talker): pass")

    def of(*settings):
        scenario = load_scenarios(base.file, overrides=[*settings, *STUDY])[3]
        return identity_of(run(scenario), scenario, Path("out"))

    return of


def test_it_has_the_attributes_of_omnetpp(identity):
    attributes = identity().attributes
    never_the_same = ("datetime", "datetimef", "processid", "inifile", "settings_hash")
    drawn = {name: attributes[name] for name in never_the_same}
    assert {name: text for name, text in attributes.items() if name not in drawn} == {
        "configname": "General",
        "experiment": "General",
        "interrupted": "false",
        "iterationvars": "$y=5, $x=2, $0=0.5s",
        "iterationvarsd": "y=5/x=2/0.5s",
        "iterationvarsf": "y=5,x=2,0.5s-",
        "measurement": "$y=5, $x=2, $0=0.5s",
        "mode": "prototype",
        "network": "Network",
        "repetition": "1",
        "replication": "#1",
        "resultdir": "out",
        "runnumber": "3",
        "seedset": "3",
    }
    assert list(attributes) == sorted(attributes)
    assert re.fullmatch(r"\d{8}-\d\d:\d\d:\d\d", drawn["datetime"])
    assert drawn["datetimef"] == drawn["datetime"].replace(":", "")


def test_its_name_is_made_of_them(identity):
    found = identity()
    attributes = found.attributes
    assert found.name == f"General-3-{attributes['datetime']}-{attributes['processid']}"


def test_labels_of_the_file(identity):
    attributes = identity("network = field.Field", "experiment-label = my ${network}").attributes
    assert (attributes["experiment"], attributes["network"]) == ("my Field", "Field")


def test_iteration_variables_that_have_a_name(identity):
    assert identity().iterations == {"x": "2", "y": "5"}


def test_settings_are_all_lines_in_their_order_with_the_values_of_the_run(identity):
    settings = identity("*.visualizer.x = 1").settings
    assert settings[:3] == (("*.visualizer.x", "1"), ("repeat", "2"), ("**.heard", "5"))
    assert ("*.uavs.count", "2") in settings
    assert settings.index(("sim-time-limit", "0.5s")) < settings.index(("sim-time-limit", "2.05s"))


def test_an_interrupted_run_says_so(make_scenario):
    scenario = make_scenario()
    result = dataclasses.replace(run(scenario), interrupted=True)
    assert identity_of(result, scenario, Path("out")).attributes["interrupted"] == "true"


def test_what_lasts_is_the_same_when_a_run_is_done_again_from_another_folder(make_scenario, monkeypatch):
    scenario = make_scenario()
    attributes = identity_of(run(scenario), scenario, Path("out")).attributes
    monkeypatch.chdir(scenario.file.parent)
    again = lasting_attributes(load_scenarios(scenario.file.name)[0], "prototype")
    assert again.items() <= attributes.items()
    assert attributes.keys() - again.keys() == {
        "datetime",
        "datetimef",
        "processid",
        "resultdir",
        "inifile",
    }
