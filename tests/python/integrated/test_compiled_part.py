import sys

import pytest

from gradysim.integrated.compiled_part import CompiledPartMissingError, load_netsim


def test_the_engine_is_there_once_it_was_built():
    assert load_netsim().__name__ == "gradysim._netsim"


def test_without_it_the_error_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "gradysim._netsim", None)
    monkeypatch.delattr("gradysim._netsim", raising=False)
    with pytest.raises(CompiledPartMissingError, match=r"`pip install \.`"):
        load_netsim()
