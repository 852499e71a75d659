from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.errors import ConfigError, Source
from gradysim.scenario.parse.ini import Entry, IniFile, Section, read_ini
from gradysim.scenario.parse.sections import check_not_abstract, config_names, search_order

Write = Callable[..., Path]


def order_of(file: Path, config: str) -> list[str]:
    return [section.name for section in search_order(read_ini(file), config)]


def section_error_of(file: Path, config: str) -> ConfigError:
    with pytest.raises(ConfigError) as caught:
        search_order(read_ini(file), config)
    return caught.value


def test_general_alone(write_ini: Write) -> None:
    assert order_of(write_ini("a = 1\n"), "General") == ["General"]


def test_own_section_then_bases_then_general(write_ini: Write) -> None:
    file = write_ini("[A]\n[B]\nextends = A\n[General]\n[C]\nextends = B\n")
    assert order_of(file, "C") == ["C", "B", "A", "General"]


@pytest.mark.parametrize(("sections", "error_line"), [(100, None), (101, 202)])
def test_a_row_of_bases_may_be_so_long(write_ini: Write, sections: int, error_line: int | None) -> None:
    chain = "".join(f"[C{index}]\nextends = C{index + 1}\n" for index in range(sections))
    file = write_ini(f"{chain}[C{sections}]\n")
    if error_line is None:
        assert len(order_of(file, "C0")) == sections + 2
    else:
        assert section_error_of(file, "C0").line == error_line


def test_bases_are_linearised_by_c3(write_ini: Write) -> None:
    file = write_ini("[O]\n[A]\nextends=O\n[B]\nextends=O\n[C]\nextends = A, B\n")
    assert order_of(file, "C") == ["C", "A", "B", "O", "General"]


def test_a_section_with_many_heirs_is_put_in_order_once(write_ini: Write) -> None:
    levels = range(49)
    diamonds = "".join(
        f"[A{level}]\nextends = B{level}, C{level}\n"
        f"[B{level}]\nextends = A{level + 1}\n[C{level}]\nextends = A{level + 1}\n"
        for level in levels
    )
    order = [name for level in levels for name in (f"A{level}", f"B{level}", f"C{level}")]
    assert order_of(write_ini(f"{diamonds}[A49]\n"), "A0") == [*order, "A49", "General"]


def test_general_as_a_base_stays_last(write_ini: Write) -> None:
    file = write_ini("[A]\n[C]\nextends = General, A\n")
    assert order_of(file, "C") == ["C", "A", "General"]


@given(st.lists(st.lists(st.integers(0, 6), max_size=3, unique=True), min_size=1, max_size=7))
def test_c3_is_that_of_python_classes(bases: list[list[int]]) -> None:
    source = Source(Path("a.ini"), 1)
    ini = IniFile(Path("a.ini"), {"General": Section("General", source)})
    classes: list[type | None] = []
    for index, wanted in enumerate(bases):
        own = [base for base in wanted if base < index and classes[base] is not None]
        ini.sections[f"S{index}"] = _section(f"S{index}", [f"S{base}" for base in own])
        try:
            classes.append(type(f"S{index}", tuple(c for base in own if (c := classes[base])), {}))
        except TypeError:
            classes.append(None)
        cls = classes[index]
        if cls is None:
            with pytest.raises(ConfigError):
                search_order(ini, f"S{index}")
        else:
            expected = [c.__name__ for c in cls.__mro__[:-1]]
            assert [section.name for section in search_order(ini, f"S{index}")] == [
                *expected,
                "General",
            ]


def _section(name: str, bases: list[str]) -> Section:
    source = Source(Path("a.ini"), 1)
    return Section(
        name,
        source,
        [Entry("extends", ", ".join(bases), source, name)] if bases else [],
    )


@pytest.mark.parametrize(
    ("text", "config", "line", "suggestion"),
    [
        ("[ZigZag5]\n[ZigZag15]\n", "Zigzag5", 0, "ZigZag5"),
        ("[A]\nextends = Bas\n[Base]\n", "A", 2, "Base"),
        ("[A]\nextends = B\n[B]\nextends = A\n", "A", 4, ""),
        ("[A]\nextends = A\n", "A", 2, ""),
        ("[A]\n[B]\nextends = A, A\n", "B", 3, ""),
        ("[A]\n[General]\nextends = A\n", "General", 3, ""),
    ],
)
def test_section_errors(write_ini: Write, text: str, config: str, line: int, suggestion: str) -> None:
    error = section_error_of(write_ini(text), config)
    assert (error.line, error.suggestion) == (line, suggestion)


@pytest.mark.parametrize("text", ["[A]\nabstract = true\n[B]\nextends = A\n", "[A]\nabstract = yes\n"])
def test_an_abstract_configuration_is_ordered_and_refused(write_ini: Write, text: str) -> None:
    file = write_ini(text)
    assert order_of(file, "A") == ["A", "General"]
    with pytest.raises(ConfigError) as caught:
        check_not_abstract(read_ini(file), "A")
    assert caught.value.line == 2


def test_abstract_is_not_inherited(write_ini: Write) -> None:
    check_not_abstract(read_ini(write_ini("[A]\nabstract = true\n[B]\nextends = A\n")), "B")


def test_names_are_those_that_can_be_run(write_ini: Write) -> None:
    assert config_names(read_ini(write_ini("[General]\n[A]\nabstract = true\n[B]\n[C]\n"))) == ["B", "C"]
    assert config_names(read_ini(write_ini("[General]\n"))) == ["General"]
