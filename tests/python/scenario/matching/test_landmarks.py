import pytest

from gradysim.scenario.matching.landmarks import Place, landmarks, names_at
from gradysim.scenario.patterns import compile_pattern


@pytest.mark.parametrize(
    ("pattern", "certain"),
    [
        ("a.b", {Place(0, False): "a", Place(1, False): "b"}),
        ("*.uavs[*].b", {Place(1, True): "uavs[", Place(2, False): "b"}),
        ("*.uavs[0..3].{a-z}", {Place(1, True): "uavs["}),
        (
            "**.uavs[3].wlan[*].b",
            {Place(-3, False): "uavs[3]", Place(-2, True): "wlan[", Place(-1, False): "b"},
        ),
        ("*.n.**.c.**.b", {Place(1, False): "n", Place(-1, False): "b"}),
        ("a.b**", {Place(0, False): "a"}),
        ("a{^x}b.c", {Place(-1, False): "c"}),
        (r"a\.b", {Place(0, False): "a", Place(1, False): "b"}),
        ("**", {}),
    ],
)
def test_which_names_are_certain(pattern: str, certain: dict[Place, str]) -> None:
    places, names = landmarks(compile_pattern(pattern))
    assert dict(zip(places, names, strict=True)) == certain


def test_names_at_places() -> None:
    places = (Place(0, False), Place(1, True), Place(-1, True))
    assert names_at(places, ["a", "b[3]", "c"]) == ("a", "b[", "")
    assert names_at(places, ["a"]) is None
