"""Each write, fsync and rename of a run fails once, or the process is killed there."""

import errno
from itertools import count

import pytest

from python.torture.faults import EARLIER, Fault, do_harm

LEAST_CALLS = 14
"""Two times four for the result, three for scalars, three for vectors."""


def test_old_or_new_results_remain_wherever_the_harm_is_done(tmp_path):
    assert_nothing_is_lost(tmp_path, [lambda number: number % 2 == 0], EARLIER[0])


@pytest.mark.verify
@pytest.mark.parametrize("earlier", EARLIER)
def test_old_or_new_results_remain_whatever_the_harm_is(tmp_path, earlier):
    assert_nothing_is_lost(tmp_path, [lambda _: False, lambda _: True], earlier)


def assert_nothing_is_lost(folder, ways, earlier):
    for way, kills in enumerate(ways):
        for number in count(1):
            place = folder / f"{way}-{number}"
            place.mkdir()
            if not do_harm(place, Fault(number, kills(number), errno.ENOSPC), earlier):
                break
        assert number > LEAST_CALLS
