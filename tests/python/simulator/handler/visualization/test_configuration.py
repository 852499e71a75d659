import math

import pytest

from gradysim.simulator.handler.visualization import VisualizationConfiguration


def test_the_defaults_are_the_published_ones():
    assert VisualizationConfiguration() == VisualizationConfiguration(
        information_collection_interval=0.01,
        update_rate=0.05,
        x_range=(-50, 50),
        y_range=(-50, 50),
        z_range=(0, 50),
        host="localhost",
        port=5678,
        open_browser=False,
    )


@pytest.mark.parametrize(
    "wrong",
    [
        {"information_collection_interval": 0},
        {"information_collection_interval": math.inf},
        {"update_rate": -1},
        {"update_rate": "fast"},
        {"x_range": (1, -1)},
        {"y_range": (0, math.nan)},
        {"z_range": 5},
        {"port": -1},
        {"port": 65536},
        {"port": "5678"},
    ],
)
def test_wrong_values_are_refused_by_name(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        VisualizationConfiguration(**wrong)
