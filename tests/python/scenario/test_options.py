from gradysim.scenario.schema import IGNORED_OPTIONS, OPTIONS, SECTION_OPTIONS


def test_options_have_no_dot() -> None:
    assert not any("." in option for option in (*OPTIONS, *SECTION_OPTIONS, *IGNORED_OPTIONS))


def test_an_option_is_read_or_ignored_or_the_sections() -> None:
    assert len({*OPTIONS, *SECTION_OPTIONS, *IGNORED_OPTIONS}) == sum(
        map(len, (OPTIONS, SECTION_OPTIONS, IGNORED_OPTIONS))
    )
