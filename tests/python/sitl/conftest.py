"""Autopilots on simulated time, in a directory that a test can inspect."""

import pytest

from gradysim.sitl.flights import Flights
from python.sitl.on_simulated_time import REFERENCE, nodes


@pytest.fixture
def own_folder(tmp_path, monkeypatch):
    """Directory of the autopilots' files, for this test alone."""
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))


@pytest.fixture
def flights_of(own_folder):
    """`flights_of(program, start, ...)`: started flights, which end after the test."""
    made = []

    def make(program, *starts, timeout_s=20.0, parameters=None, **settings):
        flights = Flights(
            nodes(program, *starts, parameters=parameters or {}), REFERENCE, timeout_s=timeout_s, **settings
        )
        made.append(flights)
        flights.begin()
        return flights

    yield make
    for flights in made:
        flights.close()
