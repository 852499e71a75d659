"""Classes whose files run once more."""

from typing import Any

from gradysim.scenario.protocol.anew import loaded_anew
from gradysim.scenario.protocol.loader import ProtocolLoader
from python.quiet_protocol import Quiet

COUNTING = """
from protocols import Sensor
from shared_list import created


class Counting(Sensor):
    here = []
    beside = created


class Other(Counting):
    pass
"""


def load(folder: Any) -> tuple[Any, Any]:
    folder.write("shared_list.py", "created = []")
    folder.write("counting.py", COUNTING)
    loader = ProtocolLoader()
    counting, other = (loader.load(f"counting.py:{name}", folder.path) for name in ("Counting", "Other"))
    return counting, other


def anew(*classes: Any) -> list[Any]:
    found = loaded_anew(classes)
    return [found[cls] for cls in classes]


def test_what_was_left_in_a_class_or_beside_it_is_not_there(folder: Any) -> None:
    counting, _ = load(folder)
    counting.here.append(1)
    counting.beside.append(1)
    [fresh] = anew(counting)
    assert (fresh.here, fresh.beside) == ([], [])
    assert (counting.here, counting.beside) == ([1], [1])


def test_classes_of_one_file_are_so_again(folder: Any) -> None:
    counting, other = load(folder)
    fresh, fresh_other = anew(counting, other)
    assert issubclass(fresh_other, fresh)
    assert not issubclass(fresh_other, counting)


def test_what_was_edited_since_is_as_it_was(folder: Any) -> None:
    counting, _ = load(folder)
    folder.write("counting.py", "raise ValueError")
    folder.write("shared_list.py", "raise ValueError")
    assert [cls.__name__ for cls in anew(counting)] == ["Counting"]


def test_the_fresh_one_can_be_loaded_anew_in_its_turn(folder: Any) -> None:
    counting, _ = load(folder)
    [fresh] = anew(counting)
    fresh.here.append(1)
    [fresher] = anew(fresh)
    assert fresher.here == []


def test_what_was_imported_by_its_name_is_left_out() -> None:
    assert loaded_anew([Quiet]) == {}
