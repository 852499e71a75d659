import pytest

from gradysim.results.node_results import node_results


def test_ends_are_paired_with_the_nodes_of_the_scenario(make_scenario):
    tracked = {"heard": 1}
    first, second = node_results(make_scenario(), [((0, 0, 1), tracked), ((0, 0, 2), {})])
    assert (first.id, first.name, first.protocol) == (0, "uavs[0]", "Tested")
    assert (first.position, first.tracked_variables) == ((0, 0, 1), {"heard": 1})
    assert (second.id, second.name, second.position) == (1, "uavs[1]", (0, 0, 2))
    tracked["heard"] = 2
    assert first.tracked_variables == {"heard": 1}


def test_a_node_without_an_end_is_an_error(make_scenario):
    with pytest.raises(ValueError, match="shorter"):
        node_results(make_scenario(), [((0, 0, 1), {})])
