import socket

import pytest

from gradysim.sitl import instance
from gradysim.sitl.error import SitlError


def test_an_instance_whose_ports_are_open_is_not_free(monkeypatch):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as busy:
        busy.bind(("0.0.0.0", 0))
        monkeypatch.setattr(instance, "_FIRST_PORTS", ((socket.SOCK_DGRAM, busy.getsockname()[1]),))
        monkeypatch.setattr(instance, "_INSTANCES", 1)
        with pytest.raises(SitlError, match="no free ports"):
            instance.free_instance(set())
    assert instance.free_instance(set()) == 0


def test_an_instance_is_given_once(monkeypatch):
    monkeypatch.setattr(instance, "_INSTANCES", 2)
    monkeypatch.setattr(instance, "_is_free", lambda number: True)
    assert instance.free_instance({0}) == 1
