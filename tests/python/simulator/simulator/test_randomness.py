import random

from simulated import build, protocol

from gradysim.encapsulator.random_stream import Purpose, RandomStream


def draws(**configuration):
    drawn = []

    def initialize(self):
        drawn.append((self.provider.random.random(), random.random()))

    simulator = build(protocol(initialize=initialize), nodes=2, **configuration)
    simulator.start_simulation()
    return drawn, simulator.seed


def test_the_same_seed_draws_the_same():
    assert draws(seed=5) == draws(seed=5)


def test_another_seed_draws_differently():
    assert draws(seed=5)[0] != draws(seed=6)[0]


def test_the_protocols_stream_has_a_name():
    assert draws(seed=5)[0][1][0] == RandomStream(5, 1, Purpose.PROTOCOL).random()


def test_pythons_own_stream_starts_with_the_run():
    assert draws(seed=5)[0][0][1] == random.Random(5).random()


def test_without_a_seed_it_is_kept_for_the_next_time():
    drawn, seed = draws()
    assert draws(seed=seed) == (drawn, seed)


def test_who_seeded_pythons_stream_gets_the_same_run_again():
    def seeded():
        random.seed(3)
        return draws()

    assert seeded() == seeded()
