import contextlib
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.scenario.errors import ConfigError, ConfigErrors
from gradysim.scenario.parse.ini import (
    PROFILES,
    IniFile,
    read_ini,
    read_overrides,
)

Write = Callable[..., Path]


def entries(ini: IniFile, section: str = "General") -> list[tuple[str, str, int]]:
    return [(entry.key, entry.text, entry.source.line) for entry in ini.sections[section].entries]


def error_of(file: Path) -> ConfigError:
    with pytest.raises(ConfigError) as caught:
        read_ini(file)
    return caught.value


def test_entries_before_any_heading_are_general(write_ini: Write) -> None:
    assert entries(read_ini(write_ini("a = 1\n[Config X]\nb = 2\n"))) == [("a", "1", 1)]


@pytest.mark.parametrize("heading", ["[Config X]", "[X]", "[ Config  X ]", "[X] # comment"])
def test_headings(write_ini: Write, heading: str) -> None:
    assert entries(read_ini(write_ini(f"{heading}\nb = 2\n")), "X") == [("b", "2", 2)]


def test_carriage_returns_and_byte_order_marks_are_stripped(write_ini: Write) -> None:
    assert entries(read_ini(write_ini("\ufeffa = 1\r\nb = 2\r\n"))) == [
        ("a", "1", 1),
        ("b", "2", 2),
    ]


def test_a_backslash_joins_without_a_newline(write_ini: Write) -> None:
    assert entries(read_ini(write_ini('a = "on\\\ne" # c\nb = 2'))) == [
        ("a", '"one"', 1),
        ("b", "2", 3),
    ]


def test_a_backslash_at_the_end_of_the_file_joins_nothing(write_ini: Write) -> None:
    assert entries(read_ini(write_ini("a = 1\nb = 2\\"))) == [("a", "1", 1), ("b", "2", 2)]


def test_an_indented_line_continues_with_a_newline(write_ini: Write) -> None:
    text = "a = 1h # one\n\n# comment\n  # another\n  5min # two\nb = 2\n"
    assert entries(read_ini(write_ini(text))) == [("a", "1h\n5min", 1), ("b", "2", 6)]


def test_a_tab_indents_too(write_ini: Write) -> None:
    assert entries(read_ini(write_ini("a = 1h\n\t5min\n"))) == [("a", "1h\n5min", 1)]


def test_a_continuation_may_have_quotes_comparisons_and_words_with_an_equals_sign(write_ini: Write) -> None:
    text = 'a = 1\n  "*.b.c = 2"\n  d.e == 3\n  where x.y is = 4\n'
    assert entries(read_ini(write_ini(text))) == [("a", '1\n"*.b.c = 2"\nd.e == 3\nwhere x.y is = 4', 1)]


def test_errors_show_a_continued_value_in_one_line(write_ini: Write) -> None:
    (entry,) = read_ini(write_ini("a = 1h\n  5min\n")).sections["General"].entries
    assert entry.source.value == "1h 5min"


def test_a_backslash_outside_of_quotes_hides_no_comment(write_ini: Write) -> None:
    assert entries(read_ini(write_ini("a = x \\# comment\n"))) == [("a", "x \\", 1)]


def test_a_hash_between_quotes_is_no_comment(write_ini: Write) -> None:
    assert entries(read_ini(write_ini('a = "x # \\" # y" # comment'))) == [("a", '"x # \\" # y"', 1)]


def test_the_first_equals_sign_splits(write_ini: Write) -> None:
    assert entries(read_ini(write_ini('a="x=y"'))) == [("a", '"x=y"', 1)]


def test_order_is_kept_and_keys_may_come_twice(write_ini: Write) -> None:
    assert [key for key, _, _ in entries(read_ini(write_ini("b = 1\na = 2\nb = 3\n")))] == ["b", "a", "b"]


def test_include_is_relative_and_goes_to_the_current_section(write_ini: Write, tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    write_ini("include more.ini\nb = 2\n", "sub/inc.ini")
    write_ini("c = 3\n", "sub/more.ini")
    ini = read_ini(write_ini("[X]\na = 1\ninclude sub/inc.ini # comment\nd = 4\n"))
    assert entries(ini, "X") == [
        ("a", "1", 2),
        ("c", "3", 1),
        ("b", "2", 2),
        ("d", "4", 4),
    ]
    assert [entry.source.file.name for entry in ini.sections["X"].entries] == [
        "test.ini",
        "more.ini",
        "inc.ini",
        "test.ini",
    ]


@pytest.mark.parametrize("profile", sorted(PROFILES.glob("*.ini")), ids=lambda file: file.stem)
def test_a_profile_of_the_package_can_be_included(write_ini: Write, profile: Path) -> None:
    ini = read_ini(write_ini(f"[X]\ninclude {profile.name}\n"))
    assert {entry.source.file for entry in ini.sections["X"].entries} == {profile}


def test_a_file_beside_has_precedence_over_a_profile(write_ini: Write) -> None:
    write_ini("a = 1\n", "as_ns3.ini")
    assert entries(read_ini(write_ini("include as_ns3.ini\n"))) == [("a", "1", 1)]


def test_sections_of_several_files_merge_and_the_current_one_stays(
    write_ini: Write,
) -> None:
    write_ini("[Y]\nb = 2\n[X]\nc = 3\n", "inc.ini")
    ini = read_ini(write_ini("[X]\na = 1\ninclude inc.ini\nd = 4\n"))
    assert [key for key, _, _ in entries(ini, "X")] == ["a", "c", "d"]
    assert [key for key, _, _ in entries(ini, "Y")] == ["b"]


def test_a_section_of_several_files_is_where_it_is_first(write_ini: Write) -> None:
    write_ini("\n\n[X]\nc = 3\n", "inc.ini")
    source = read_ini(write_ini("[X]\na = 1\ninclude inc.ini\n")).sections["X"].source
    assert (source.file.name, source.line) == ("test.ini", 1)


def test_a_file_may_be_included_twice(write_ini: Write) -> None:
    write_ini("a = 1\n", "inc.ini")
    ini = read_ini(write_ini("[X]\ninclude inc.ini\n[Y]\ninclude inc.ini\n"))
    assert entries(ini, "X") == entries(ini, "Y")


@pytest.mark.parametrize(
    ("text", "line", "suggestion"),
    [
        ("a = 1\n; old\n", 2, ""),
        ("a = 1\n// old\n", 2, ""),
        ("a = 1\n  ; old\n", 2, ""),
        ('\na = "x\n', 2, ""),
        ("a 1\n", 1, ""),
        ("= 1\n", 1, ""),
        ("a = # 1\n", 1, ""),
        ("  a = 1\n", 1, ""),
        ("[X]\n  a = 1\n", 2, ""),
        ("[X]\na = 1\n\n  *.uavs[*].mobility.speed = 3mps\n", 4, ""),
        ("a = 1\n\tseed-set = 3\n", 2, ""),
        ("[X\n", 1, ""),
        ("[Foo X]\n", 1, ""),
        ("[Config General]\n", 1, ""),
        ("[Config a/b]\n", 1, ""),
        ("[..\\a]\n", 1, ""),
        ("[X]\n[Y]\n[Config X]\n", 3, ""),
        ("\ninclude test.ini\n", 2, ""),
        ("*.uavs[${n}].x = 3\n", 1, ""),
        ("include tst.ini\n", 1, "test.ini"),
        ("include as_ns_3.ini\n", 1, "as_ns3.ini"),
    ],
)
def test_errors(write_ini: Write, text: str, line: int, suggestion: str) -> None:
    error = error_of(write_ini(text))
    assert (error.line, error.suggestion) == (line, suggestion)


def test_all_errors_are_reported_by_line(write_ini: Write) -> None:
    error = error_of(write_ini('a = 1\n; old\nb\n[X\nc = 2\nd = "\n'))
    assert isinstance(error, ConfigErrors)
    assert [each.line for each in error.errors] == [2, 3, 4, 6]


def test_errors_of_included_files_are_reported_with_those_of_the_file(write_ini: Write) -> None:
    write_ini("a\n", "inc.ini")
    error = error_of(write_ini("include inc.ini\nb\n"))
    assert isinstance(error, ConfigErrors)
    assert [(each.file and each.file.name, each.line) for each in error.errors] == [
        ("inc.ini", 1),
        ("test.ini", 2),
    ]


def test_a_circle_of_includes_is_an_error(write_ini: Write) -> None:
    write_ini("\n\ninclude test.ini\n", "inc.ini")
    error = error_of(write_ini("include inc.ini\n"))
    assert (error.file and error.file.name, error.line) == ("inc.ini", 3)


def test_a_row_of_includes_may_be_so_long(write_ini: Write) -> None:
    for number in range(1, 102):
        write_ini(f"include inc{number + 1}.ini\n", f"inc{number}.ini")
    write_ini("", "inc101.ini")
    whole = write_ini("include inc2.ini\n")
    assert read_ini(whole)
    write_ini("include inc1.ini\n")
    error = error_of(whole)
    assert (error.file and error.file.name, error.line) == ("inc100.ini", 1)


def test_a_file_that_includes_itself_by_another_name_is_found_out(write_ini: Write, tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    assert error_of(write_ini("include sub/../test.ini\n")).line == 1


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be"])
def test_a_zero_byte_is_no_text(tmp_path: Path, encoding: str) -> None:
    file = tmp_path / "test.ini"
    file.write_bytes(b"a = 1\n" + "b = 2\n".encode(encoding))
    error = error_of(file)
    assert (error.line, error.expected) == (2, "UTF-8")


def test_a_link_that_leads_to_itself_is_no_file(write_ini: Write, tmp_path: Path) -> None:
    (tmp_path / "loop.ini").symlink_to("loop.ini")
    assert error_of(write_ini("include loop.ini\n")).line == 1


@pytest.mark.parametrize("name", ["m" * 300, "m" * 5000, "m" * 5000 + "/more.ini"])
def test_a_name_that_no_file_has_is_an_error(write_ini: Write, name: str) -> None:
    error = error_of(write_ini(f"include {name}\n"))
    assert (error.line, error.expected) == (1, "an .ini file")


def test_a_missing_file_has_no_line(tmp_path: Path, write_ini: Write) -> None:
    write_ini("a = 1\n", "zigzag.ini")
    error = error_of(tmp_path / "zizag.ini")
    assert (error.line, error.suggestion) == (0, "zigzag.ini")


def test_other_encodings_are_errors(tmp_path: Path) -> None:
    file = tmp_path / "latin.ini"
    file.write_bytes(b"a = 1\ndescription = \xe9t\xe9\n")
    error = error_of(file)
    assert (error.line, error.expected) == (2, "UTF-8")


def test_overrides_have_line_0() -> None:
    (entry,) = read_overrides(Path("a.ini"), ['*.x.y = "a=b"'])
    assert (entry.key, entry.text, entry.rank) == ("*.x.y", '"a=b"', 0)
    assert str(entry.source) == 'override *.x.y="a=b"'


@pytest.mark.parametrize("override", ["repeat", "repeat=", "=3"])
def test_overrides_need_key_and_value(override: str) -> None:
    with pytest.raises(ConfigError):
        read_overrides(Path("a.ini"), [override])


def test_all_bad_overrides_are_reported() -> None:
    with pytest.raises(ConfigErrors) as caught:
        read_overrides(Path("a.ini"), ["repeat", "seed-set=3", "*.${x}.y=1"])
    assert len(caught.value.errors) == 2


@pytest.mark.parametrize("overrides", ["repeat=2", {"repeat": "2"}, [2], 2])
def test_overrides_are_a_list_of_texts(overrides: Any) -> None:
    with pytest.raises(TypeError):
        read_overrides(Path("a.ini"), overrides)


@pytest.mark.parametrize("byte", [b"\0", b"\x1b", b"\x07", b"\x7f"])
def test_a_file_that_is_not_text_is_not_quoted(tmp_path: Path, byte: bytes) -> None:
    file = tmp_path / "test.ini"
    file.write_bytes(b"[General]\nsecret" + byte + b"secret = 1\n")
    with pytest.raises(ConfigError) as caught:
        read_ini(file)
    assert (caught.value.line, caught.value.expected) == (2, "UTF-8")
    assert "secret" not in str(caught.value)


def test_of_a_file_that_is_no_scenario_an_error_quotes_little(write_ini: Write) -> None:
    error = error_of(write_ini("[General]\n" + "secret " * 10_000))
    assert error.line == 2
    assert str(error).count("secret") <= 200 / len("secret")


def test_an_override_that_is_not_utf_8_is_refused() -> None:
    with pytest.raises(ConfigError) as caught:
        read_overrides(Path("a.ini"), ["*.x.label=\udcff"], "--set")
    str(caught.value).encode()
    assert caught.value.expected == "KEY=VALUE in UTF-8"


def test_includes_may_be_indented_and_keys_may_begin_with_include(write_ini: Write) -> None:
    ini = read_ini(write_ini("[General]\ninclude   = 3\n"))
    assert [entry.key for entry in ini.sections["General"].entries] == ["include"]


@pytest.mark.parametrize(
    "text",
    [
        "a = 1\n " + "." * 300_000,
        "a = 1\n ." + " " * 300_000 + ".",
        "[" + " " * 300_000,
        "include" + " " * 300_000,
    ],
)
def test_long_lines_take_little_time(write_ini: Write, text: str) -> None:
    file = write_ini("[General]\n" + text)
    started_s = time.process_time()
    with contextlib.suppress(ConfigError):
        read_ini(file)
    assert time.process_time() - started_s < 5  # it took minutes
