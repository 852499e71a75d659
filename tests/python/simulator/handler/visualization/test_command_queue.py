from gradysim.simulator.handler.visualization.messages import CommandQueue


def paint(node_id, color):
    return {"command": "paint_node", "payload": {"node_id": node_id, "color": color}}


def taken(queue):
    return [queue.get() for _ in range(queue.qsize())]


def test_first_in_first_out():
    queue = CommandQueue()
    for color in range(3):
        queue.put(paint(0, color))
    assert taken(queue) == [paint(0, 0), paint(0, 1), paint(0, 2)]


def test_when_they_become_many_the_last_of_each_kind_and_node_stay():
    queue = CommandQueue()
    for color in range(10_001):
        queue.put(paint(color % 3, color))
    assert taken(queue) == [paint(2, 9998), paint(0, 9999), paint(1, 10000)]


def test_its_length_is_bounded():
    queue = CommandQueue()
    for color in range(100_000):
        queue.put(paint(color % 7, color))
    assert queue.qsize() <= 10_000


def test_many_nodes_are_all_kept():
    queue = CommandQueue()
    for color in range(3):
        for node_id in range(12_000):
            queue.put(paint(node_id, color))
    last = {command["payload"]["node_id"]: command["payload"]["color"] for command in taken(queue)}
    assert last == dict.fromkeys(range(12_000), 2)
