"""The ArduCopter program: its options, parameters and ports."""

import socket
from pathlib import Path

import pytest

from gradysim.sitl import SitlError, arducopter
from gradysim.sitl.arducopter import find_arducopter, options, parameter_file

NEW, OLD = "--serial0 --uartA --sysid", "--uartA"


@pytest.fixture(autouse=True)
def _nothing_else_is_named(monkeypatch):
    monkeypatch.delenv("GRADYSIM_ARDUPILOT", raising=False)
    monkeypatch.setenv("PATH", "")


@pytest.fixture
def checkout(tmp_path):
    """Return a directory as left by ArduPilot's build."""
    program = tmp_path / "build/sitl/bin/arducopter"
    program.parent.mkdir(parents=True)
    program.touch(mode=0o755)
    return tmp_path


def test_a_program_is_itself(checkout):
    program = checkout / "build/sitl/bin/arducopter"
    assert find_arducopter(program) == program


def test_in_a_checkout_it_is_where_the_build_puts_it(checkout):
    assert find_arducopter(str(checkout)) == checkout / "build/sitl/bin/arducopter"


def test_the_environment_may_name_it(checkout, monkeypatch):
    monkeypatch.setenv("GRADYSIM_ARDUPILOT", str(checkout))
    assert find_arducopter(None) == checkout / "build/sitl/bin/arducopter"


def test_it_may_be_a_command(checkout, monkeypatch):
    monkeypatch.setenv("PATH", str(checkout / "build/sitl/bin"))
    assert find_arducopter(None) == checkout / "build/sitl/bin/arducopter"


def test_without_any_it_says_what_to_give():
    with pytest.raises(SitlError, match=r"mobility\.autopilotPath(.|\n)*GRADYSIM_ARDUPILOT"):
        find_arducopter(None)


def test_a_checkout_that_was_not_built_is_told_how(tmp_path):
    with pytest.raises(SitlError, match="waf"):
        find_arducopter(tmp_path)


def test_what_cannot_be_executed_is_refused(tmp_path):
    (tmp_path / "program").touch(mode=0o644)
    with pytest.raises(SitlError, match="executable"):
        find_arducopter(tmp_path / "program")


def started_with(help_text):
    words = options(
        home=(-15.84, -47.92, 1000),
        speedup=2.5,
        parameters=Path("/p"),
        instance=3,
        system_id=8,
        port=1234,
        help_text=help_text,
    )
    return " ".join(words)


def test_it_is_started_with_what_its_version_knows():
    home = "--home -15.8400000,-47.9200000,1000.000,0"
    same = f"--wipe --model quad {home} --speedup 2.5 --defaults /p --instance 3"
    assert started_with(NEW) == f"{same} --sysid 8 --serial0 tcpclient:127.0.0.1:1234"
    assert started_with(OLD) == f"{same} --uartA tcpclient:127.0.0.1:1234"


def test_an_old_version_gets_its_id_as_a_parameter():
    assert "SYSID_THISMAV" not in parameter_file(system_id=8, help_text=NEW, more={})
    assert "SYSID_THISMAV 8\n" in parameter_file(system_id=8, help_text=OLD, more={})


def test_a_parameter_keeps_all_digits_that_an_autopilot_knows():
    assert "MASK 16777215\n" in parameter_file(system_id=8, help_text=NEW, more={"MASK": 16777215})


def test_more_parameters_win():
    lines = parameter_file(
        system_id=8, help_text=NEW, more={"BATT_MONITOR": 0, "WPNAV_ACCEL": 250}
    ).splitlines()
    assert "BATT_MONITOR 0" in lines
    assert "WPNAV_ACCEL 250" in lines
    assert len(lines) == len({line.split()[0] for line in lines})


def test_an_instance_whose_ports_are_open_is_not_free(monkeypatch):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as busy:
        busy.bind(("0.0.0.0", 0))
        monkeypatch.setattr(arducopter, "_FIRST_PORTS", ((socket.SOCK_DGRAM, busy.getsockname()[1]),))
        monkeypatch.setattr(arducopter, "_INSTANCES", 1)
        with pytest.raises(SitlError, match="ports"):
            arducopter.free_instance(set())
    assert arducopter.free_instance(set()) == 0


def test_an_instance_is_given_once(monkeypatch):
    monkeypatch.setattr(arducopter, "_INSTANCES", 2)
    monkeypatch.setattr(arducopter, "_is_free", lambda number: True)
    assert arducopter.free_instance({0}) == 1
