"""Path loss and fading through the Python bindings: for link budgets and tests/verification."""

import math

import pytest

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")

from gradysim._netsim import ConfigError, MediumConfig, Propagation

CARRIER_HZ = 2.412e9
HERE, THERE = (0.0, 0.0, 10.0), (300.0, 400.0, 10.0)


def propagation(path_loss: str, seed: int = 1, **fields: float) -> Propagation:
    config = MediumConfig()
    config.path_loss = path_loss
    for field, value in fields.items():
        setattr(config, field, value)
    return Propagation(config, seed)


def test_free_space_is_that_of_friis() -> None:
    expected = (299_792_458 / CARRIER_HZ / (4 * math.pi * 500)) ** 2
    assert propagation("FreeSpacePathLoss").gain(HERE, THERE, CARRIER_HZ) == pytest.approx(
        expected, rel=1e-12
    )


def test_reach_inverts_free_space() -> None:
    free_space = propagation("FreeSpacePathLoss")
    gain = free_space.gain(HERE, THERE, CARRIER_HZ)
    assert free_space.reach_m(gain, CARRIER_HZ) == pytest.approx(500)
    assert free_space.most_gain_beyond(500, CARRIER_HZ) == pytest.approx(gain)


def test_fading_depends_on_seed_nodes_and_time_and_on_nothing_else() -> None:
    fading = propagation("RayleighFading")
    gain = fading.gain(HERE, THERE, CARRIER_HZ, 3, 4, 1.0)
    assert fading.gain(THERE, HERE, CARRIER_HZ, 4, 3, 1.0, transmission=7) == gain
    assert propagation("RayleighFading").gain(HERE, THERE, CARRIER_HZ, 3, 4, 1.0) == gain
    assert propagation("RayleighFading", seed=2).gain(HERE, THERE, CARRIER_HZ, 3, 4, 1.0) != gain
    assert fading.gain(HERE, THERE, CARRIER_HZ, 3, 5, 1.0) != gain
    assert fading.gain(HERE, THERE, CARRIER_HZ, 3, 4, 1.1) != gain


def test_without_a_coherence_time_each_transmission_fades_for_itself() -> None:
    fading = propagation("RicianFading", coherence_time_s=0.0)
    gain = fading.gain(HERE, THERE, CARRIER_HZ, transmission=1)
    assert fading.gain(HERE, THERE, CARRIER_HZ, time=5.0, transmission=1) == gain
    assert fading.gain(HERE, THERE, CARRIER_HZ, transmission=2) != gain


def test_a_value_out_of_range_is_refused() -> None:
    with pytest.raises(ConfigError, match=r"medium\.shape_factor = 0\.1: .* 0\.5 to 1000"):
        propagation("NakagamiFading", shape_factor=0.1)


def test_the_unit_disk_has_no_path_loss() -> None:
    with pytest.raises(ConfigError, match="UnitDiskRadioMedium"):
        Propagation(MediumConfig("UnitDiskRadioMedium"), 1)
