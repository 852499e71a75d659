"""The options of a run, and the name of the network."""

from pathlib import Path

import pytest

from gradysim.scenario.errors import ConfigError, Source
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.schema.options import IGNORED_OPTIONS, OPTIONS, SECTION_OPTIONS, network_name


def test_options_have_no_dot() -> None:
    assert not any("." in option for option in (*OPTIONS, *SECTION_OPTIONS, *IGNORED_OPTIONS))


def test_an_option_is_read_or_ignored_or_the_sections() -> None:
    assert len({*OPTIONS, *SECTION_OPTIONS, *IGNORED_OPTIONS}) == sum(
        map(len, (OPTIONS, SECTION_OPTIONS, IGNORED_OPTIONS))
    )


def test_the_name_of_the_network_has_no_variables() -> None:
    network = Entry("network", "${x=A, B}", Source(Path("a.ini"), 9, "network", "${x=A, B}"))
    with pytest.raises(ConfigError) as caught:
        network_name([network])
    assert caught.value.line == 9


@pytest.mark.parametrize(
    ("text", "name"),
    [("Field", "Field"), ('"Field"', "Field"), ("a.b_2.Field", "Field"), ('"a.Field"', "Field")],
)
def test_the_name_of_the_network_may_follow_packages(text: str, name: str) -> None:
    assert network_name([Entry("network", text, Source(Path("a.ini"), 9))]) == name


@pytest.mark.parametrize(
    "text", ["a.", ".a", "*", "a b", "a..b", '"a', "2a", '""', "a-b", "a.*", "fl\u00e4che"]
)
def test_what_is_no_name_of_a_network_is_refused(text: str) -> None:
    network = Entry("network", text, Source(Path("a.ini"), 9, "network", text))
    with pytest.raises(ConfigError) as caught:
        network_name([network])
    assert (caught.value.line, caught.value.value) == (9, text)
