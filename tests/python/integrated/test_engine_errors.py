from pathlib import Path

import pytest

from gradysim.config.error import ConfigError
from gradysim.config.scenario import Setting, Source
from gradysim.integrated.engine_errors import errors_at, named_in


def setting(value, key="key"):
    return Setting(value, Source(Path("a.ini"), 7, key))


def test_an_error_that_names_no_setting_is_one_without_a_place():
    with pytest.raises(ConfigError) as error, errors_at({"power_w": setting(0)}):
        raise ValueError("nothing works")
    assert str(error.value) == "nothing works"


def test_the_field_that_is_named_first_is_the_wrong_one():
    settings = {"cw_max": setting(3), "cw_min": setting(7)}
    assert named_in("mac.cw_min = 7: expected at most mac.cw_max = 3", settings) is settings["cw_min"]


def test_a_part_of_a_name_is_no_name():
    assert named_in("radio.tx_power_w = 0", {"power_w": setting(0)}) is None
