import re

import pytest

from gradysim.results.node_ids import checked_ids


def test_ids_of_numpy_are_ids():
    numpy = pytest.importorskip("numpy")
    (node_id,) = checked_ids("fates_at", [numpy.int64(1)], 2, "ids")
    assert type(node_id) is int


@pytest.mark.parametrize("node_id", [-1, 2])
def test_an_id_that_is_not_there_is_named(node_id):
    with pytest.raises(
        ValueError, match=rf"^fates_at: there is no node {node_id}; expected ids of the 2 nodes, from 0$"
    ):
        checked_ids("fates_at", [0, node_id], 2, "ids")


@pytest.mark.parametrize("ids", [True, "all", [0.5], [None]])
def test_what_is_no_id_is_shown(ids):
    with pytest.raises(TypeError, match=rf"^fates_at = {re.escape(repr(ids))}: expected ids$"):
        checked_ids("fates_at", ids, 2, "ids")
