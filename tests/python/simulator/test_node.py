from gradysim.simulator.node import Node


def test_a_node_is_made_without_arguments_and_filled_in():
    node = Node()
    node.id, node.position, node.protocol_encapsulator = 1, (0, 0, 0), object()
    assert node.seed == 0
