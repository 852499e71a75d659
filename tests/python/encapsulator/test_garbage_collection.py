import gc

import pytest

from gradysim.encapsulator.garbage_collection import garbage_left_alone


class TestGarbageLeftAlone:
    def test_nothing_is_looked_for_inside_and_afterwards_it_is_again(self):
        with garbage_left_alone():
            assert not gc.isenabled()
        assert gc.isenabled()

    def test_it_is_looked_for_again_after_a_failure(self):
        with pytest.raises(ValueError, match="no such node"), garbage_left_alone():
            raise ValueError("no such node")
        assert gc.isenabled()

    def test_who_has_switched_it_off_keeps_it_off(self):
        gc.disable()
        try:
            with garbage_left_alone():
                pass
            assert not gc.isenabled()
        finally:
            gc.enable()
