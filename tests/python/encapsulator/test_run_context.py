import gc
import random

import pytest

from gradysim.encapsulator.run_context import GlobalRandom, gc_paused


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
    with GlobalRandom(5).in_use():
        assert random.random() == random.Random(5).random()
    assert random.getstate() == before


def test_pythons_random_goes_on_where_the_run_left_it():
    of_run, expected = GlobalRandom(5), random.Random(5)
    for _ in range(2):
        with of_run.in_use():
            assert random.random() == expected.random()
