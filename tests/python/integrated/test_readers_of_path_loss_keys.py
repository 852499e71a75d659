"""A path loss reads exactly the fields of its keys: `gradysim run` warns of all others."""

import pytest

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")

from gradysim._netsim import MediumConfig, Propagation
from gradysim.scenario.schema.engine_keys import Key
from gradysim.scenario.schema.keys import PATH_LOSS_KEYS

TYPENAME, *KEYS_OF_PARAMETERS = PATH_LOSS_KEYS
MODELS = TYPENAME.kind.names


def other_value(key: Key) -> float | str | bool:
    """Return a value of the key that is not its default."""
    default = key.defaults[""]
    if isinstance(default, bool):
        return not default
    if isinstance(default, str):
        return next(name for name in key.kind.names if name != default)
    return default + 1 if default < 1 else 1.5 * default


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


@pytest.mark.parametrize("model", MODELS)
def test_fields_that_change_the_gain_are_those_whose_keys_name_the_model(model: str) -> None:
    read = set()
    for key in KEYS_OF_PARAMETERS:
        others = {"polarization": "vertical"} if key.field == "inet_vertical_sign" else {}
        if gains(model, **others, **{key.field: other_value(key)}) != gains(model, **others):
            read.add(key.field)
    assert read == {key.field for key in KEYS_OF_PARAMETERS if key.read_by and model in key.read_by.names}
