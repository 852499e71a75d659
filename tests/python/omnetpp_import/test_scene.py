"""The origin of geographic positions."""

from collections.abc import Callable

import pytest

from gradysim.omnetpp_import import Translation

TEXT = """[General]
*.coordinateSystem.sceneLatitude = 10deg
*.quads[0].mobility.coordinateSystemModule = "coordinateSystem"
*.quads[0].mobility.initialLatitude = 10.001deg
[Config Here]
*.quads[0].mobility.initialLongitude = 0.001deg
[Config There]
*.coordinateSystem.sceneLatitude = 60deg
[Config Heir]
extends = There
*.quads[0].mobility.initialLongitude = 0.001deg
"""


@pytest.mark.parametrize(
    ("section", "expected"),
    [("General", "initialX = 111.195m"), ("Here", "initialY = 109.506m"), ("Heir", "initialY = 55.597m")],
)
def test_each_section_has_its_own(
    translated: Callable[..., Translation], section: str, expected: str
) -> None:
    text = translated(TEXT).text
    assert expected in text[text.index(f"{section}]") :].partition("\n[")[0]
