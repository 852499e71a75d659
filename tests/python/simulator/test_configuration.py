import math

import pytest

from gradysim.simulator.configuration import SimulationConfiguration


def test_the_defaults_are_the_published_ones():
    assert SimulationConfiguration() == SimulationConfiguration(
        duration=None,
        max_iterations=None,
        real_time=False,
        debug=False,
        log_file=None,
        execution_logging=True,
        profile=False,
        timing_report=False,
        seed=None,
    )


@pytest.mark.parametrize(
    "right",
    [
        {},
        {"duration": 0},
        {"duration": math.inf},
        {"max_iterations": 0},
        {"real_time": True},
        {"real_time": 0.5},
        {"seed": 0},
    ],
)
def test_right_values(right):
    SimulationConfiguration(**right).validate()


@pytest.mark.parametrize(
    "wrong",
    [
        {"duration": -1},
        {"duration": math.nan},
        {"max_iterations": -1},
        {"max_iterations": 1.5},
        {"real_time": -1},
        {"real_time": math.inf},
        {"seed": -1},
        {"seed": 1.0},
        {"seed": True},
        {"duration": "5"},
        {"real_time": "yes"},
        {"log_file": 5},
    ],
)
def test_wrong_values_are_refused_by_name(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        SimulationConfiguration(**wrong).validate()


def test_the_fields_come_in_the_published_order():
    assert SimulationConfiguration(5.0, 10, 2.0, True, None, False, True, True) == SimulationConfiguration(
        duration=5.0,
        max_iterations=10,
        real_time=2.0,
        debug=True,
        log_file=None,
        execution_logging=False,
        profile=True,
        timing_report=True,
    )
