"""A path loss reads exactly the fields of its keys: `gradysim run` warns of all others."""

import re

import pytest

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")

from gradysim._netsim import MediumConfig, Propagation
from gradysim.scenario.keys import PATH_LOSS_KEYS

TYPENAME, *KEYS_OF_PARAMETERS = PATH_LOSS_KEYS
MODELS = re.findall(r'"(\w+)"', TYPENAME.kind.expected)

OTHER_VALUES = {
    "alpha": 3.0,
    "system_loss": 2.0,
    "breakpoint_distance_m": 20.0,
    "l01_db": 30.0,
    "l02_db": 70.0,
    "alpha1": 2.5,
    "alpha2": 4.0,
    "epsilon_r": 5.0,
    "polarization": "vertical",
    "inet_vertical_sign": True,
    "sigma_db": 4.0,
    "k_db": 2.0,
    "shape_factor": 3.0,
    "coherence_time_s": 0.02,
}
"""For each field a value that is not its default."""

SENDER = (0.0, 0.0, 2.0)
RECEIVERS = [(distance_m, 0.0, height_m) for distance_m in (3, 15, 50, 400, 3000) for height_m in (1.5, 30)]
TIMES_S = (0.0, 0.0031, 0.4)


def gains(model: str, **fields: float | str | bool) -> list[float]:
    config = MediumConfig()
    config.path_loss = model
    for field, value in fields.items():
        setattr(config, field, value)
    propagation = Propagation(config, 1)
    return [
        propagation.gain(SENDER, receiver, 2.4e9, time=time_s) for receiver in RECEIVERS for time_s in TIMES_S
    ]


def test_each_field_is_tried() -> None:
    assert OTHER_VALUES.keys() == {key.field for key in KEYS_OF_PARAMETERS}


@pytest.mark.parametrize("model", MODELS)
def test_fields_that_change_the_gain_are_those_whose_keys_name_the_model(model: str) -> None:
    read = set()
    for field, value in OTHER_VALUES.items():
        others = {"polarization": "vertical"} if field == "inet_vertical_sign" else {}
        if gains(model, **others, **{field: value}) != gains(model, **others):
            read.add(field)
    assert read == {key.field for key in KEYS_OF_PARAMETERS if key.read_by and model in key.read_by.names}
