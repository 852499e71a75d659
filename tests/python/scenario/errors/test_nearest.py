import pytest

from gradysim.scenario.errors.nearest import did_you_mean, misspelt, nearest

NAMES = ["sim-time-limit", "seed-set", "repeat", "heartbeat_jitter"]


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("sim-time-limt", "sim-time-limit"),
        ("Repeat", "repeat"),
        ("jitter", "heartbeat_jitter"),
        ("zzz", None),
        ("e", None),
    ],
)
def test_finds_the_nearest(name: str, expected: str | None) -> None:
    assert nearest(name, NAMES) == expected


@pytest.mark.parametrize(("name", "expected"), [("mw", "mW"), ("Mw", "MW"), ("mW", "mW")])
@pytest.mark.parametrize("names", [["MW", "mW"], ["mW", "MW"]])
def test_case_decides_between_names_that_differ_in_nothing_else(
    name: str, expected: str, names: list[str]
) -> None:
    assert nearest(name, names) == expected


def test_a_part_of_several_names_is_near_to_none() -> None:
    assert nearest("time", ["a-long-name-with-time-in-it", "another-long-name-with-time"]) is None


def test_ends_a_message() -> None:
    assert did_you_mean("seedset", NAMES) == "; did you mean `seed-set`?"
    assert did_you_mean("zzz", NAMES) == ""


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("materail", "material"),
        ("Material", "material"),
        ("matrial", "material"),
        ("hieght", "height"),
        ("hight", "height"),
        ("relative_permittivity", "relativePermittivity"),
        ("relativePermitivity", "relativePermittivity"),
        ("bse", "base"),
        ("case", None),
        ("min_height", None),
        ("building:material", None),
        ("building:levels", None),
        ("basement", None),
        ("relative", None),
        ("", None),
    ],
)
def test_a_misspelt_name_is_but_a_slip_away(name: str, expected: str | None) -> None:
    assert misspelt(name, ["height", "base", "material", "relativePermittivity"]) == expected
