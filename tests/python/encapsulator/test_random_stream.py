from gradysim.encapsulator.random_stream import random_stream


def test_equal_names_give_equal_streams():
    assert random_stream(7, 3, "protocol").random() == random_stream(7, 3, "protocol").random()


def test_seed_node_and_purpose_each_make_another_stream():
    names = [(7, 3, "protocol"), (8, 3, "protocol"), (7, 4, "protocol"), (7, 3, "communication")]
    assert len({random_stream(*name).random() for name in names}) == len(names)


def test_neighbouring_numbers_do_not_run_together():
    assert random_stream(1, 11, "protocol").random() != random_stream(11, 1, "protocol").random()


def test_a_stream_is_the_same_on_every_platform():
    stream = random_stream(0, 0, "protocol")
    assert [stream.randrange(1000) for _ in range(5)] == [765, 258, 214, 344, 399]
