import pickle
from pathlib import Path

from gradysim.scenario.errors.config_error import BadValue, ConfigError
from gradysim.scenario.errors.source import Source

SOURCE = Source(Path("a.ini"), 7, "*.x.mobility.speed", "-1mps")


def test_tells_the_place_and_the_mistake() -> None:
    error = ConfigError("no such thing; expected another", SOURCE)
    assert str(error) == "a.ini:7: no such thing; expected another"
    assert (error.message, error.file, error.line, error.key) == (
        "no such thing; expected another",
        Path("a.ini"),
        7,
        "*.x.mobility.speed",
    )


def test_may_have_no_place() -> None:
    error = ConfigError("runs = x: expected numbers")
    assert str(error) == "runs = x: expected numbers"
    assert (error.source, error.file, error.line, error.key) == (None, None, 0, "")


def test_at_adds_the_entry_to_somebody_elses_text() -> None:
    assert str(ConfigError.at(SOURCE, "out of range")) == "a.ini:7: *.x.mobility.speed = -1mps: out of range"


def test_at_leaves_most_of_a_long_value_out() -> None:
    source = Source(Path("a.ini"), 7, "*.x.points", "1" * 5000)
    assert str(ConfigError.at(source, "out of range")) == f"a.ini:7: *.x.points = {'1' * 100}…: out of range"


def test_a_message_leaves_most_of_a_long_word_out() -> None:
    error = ConfigError(f"that is {'1' * 100_000}: out of range; expected {'a' * 999}", SOURCE)
    assert str(error) == f"a.ini:7: that is {'1' * 100}… out of range; expected {'a' * 999}"
    assert str(pickle.loads(pickle.dumps(error))) == str(error)


def test_at_does_not_repeat_what_an_override_says() -> None:
    source = Source(Path("a.ini"), 0, "repeat", "0", "--set")
    assert str(ConfigError.at(source, "out of range")) == "--set repeat=0: out of range"


def test_survives_pickling() -> None:
    error = pickle.loads(pickle.dumps(ConfigError("wrong", SOURCE)))
    assert (str(error), error.source) == ("a.ini:7: wrong", SOURCE)


def test_bad_value_holds_its_suggestion_apart() -> None:
    error = BadValue("no unit `sec`", "; did you mean `s`?")
    assert (str(error), error.problem) == (
        "no unit `sec`; did you mean `s`?",
        "no unit `sec`",
    )
