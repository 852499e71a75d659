"""Where classes come from."""

import gc
from pathlib import Path

from gradysim.scenario.protocol.module import ModuleLoader
from gradysim.scenario.protocol.origin import Origin, class_loaded_from, origin_of, remember_origin
from python.quiet_protocol import Quiet

LOADER = ModuleLoader()


def new_class() -> type[Quiet]:
    return type("Tested", (Quiet,), {})


def test_a_class_and_where_it_comes_from_lead_to_each_other() -> None:
    tested, origin = new_class(), Origin(Path("/a.py"), "Tested", "first")
    remember_origin(tested, origin, LOADER)
    assert (origin_of(tested), class_loaded_from(origin)) == (origin, tested)


def test_another_load_of_the_file_is_another_class() -> None:
    tested = new_class()
    remember_origin(tested, Origin(Path("/b.py"), "Tested", "first"), LOADER)
    assert class_loaded_from(Origin(Path("/b.py"), "Tested", "second")) is None


def test_the_first_place_counts() -> None:
    """A class that another file imports is still that of its own."""
    tested, own = new_class(), Origin(Path("/c.py"), "Tested", "first")
    remember_origin(tested, own, LOADER)
    remember_origin(tested, Origin(Path("/d.py"), "Tested", "first"), LOADER)
    assert origin_of(tested) == own


def test_a_class_that_was_imported_has_no_such_place() -> None:
    assert origin_of(Quiet) is None


def test_a_class_that_nobody_has_is_forgotten() -> None:
    origin = Origin(Path("/e.py"), "Tested", "first")
    remember_origin(new_class(), origin, LOADER)
    gc.collect()
    assert class_loaded_from(origin) is None
