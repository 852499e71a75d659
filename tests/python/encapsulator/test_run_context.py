import gc
import random

import pytest

from gradysim.encapsulator.run_context import gc_paused, global_random_seeded


def test_the_collector_is_off_inside_and_on_afterwards():
    with gc_paused():
        assert not gc.isenabled()
    assert gc.isenabled()


def test_the_collector_is_on_after_a_failure():
    with pytest.raises(ZeroDivisionError), gc_paused():
        raise ZeroDivisionError
    assert gc.isenabled()


def test_a_collector_that_was_off_stays_off():
    gc.disable()
    try:
        with gc_paused():
            pass
        assert not gc.isenabled()
    finally:
        gc.enable()


def test_pythons_random_is_seeded_inside_and_restored_afterwards():
    before = random.getstate()
    with global_random_seeded(5):
        assert random.random() == random.Random(5).random()
    assert random.getstate() == before
