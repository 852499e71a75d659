"""`gradysim keys`."""

import contextlib
import io

from gradysim.cli.app import main
from python.cli.command import run_without


def test_keys_are_plain_lines_when_there_is_no_terminal(gradysim):
    done = gradysim("keys", "mobility.speed")
    assert done.returncode == 0
    assert [line.split("\t")[0] for line in done.stdout.splitlines()] == ["*.nodes[*].mobility.speed"]


def test_keys_are_paragraphs_on_a_terminal():
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    with contextlib.redirect_stdout(Terminal()) as shown:
        assert main(["keys", "mobility.speed"]) == 0
    assert "mobility.speed\x1b[0m\n    mps; " in shown.getvalue()


def test_keys_are_a_page_in_markdown_if_it_is_asked_for(gradysim):
    page = gradysim("keys", "mobility.speed", "--markdown").stdout
    assert page.startswith("# Keys of .ini files\n\n")
    assert page.splitlines()[-1].startswith("| `*.nodes[*].mobility.speed` | mps | ")


def test_a_key_is_found_by_a_value_that_it_may_take(gradysim):
    done = gradysim("keys", "ardupilotmobility")
    assert done.returncode == 0
    assert "*.nodes[*].mobility.typename" in [line.split("\t")[0] for line in done.stdout.splitlines()]


def test_a_pattern_that_no_key_matches_is_a_mistake(gradysim):
    done = gradysim("keys", "sensitivty")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.endswith(" `sensitivity`?\n")


def test_keys_of_the_engine_are_listed_without_the_compiled_part(folder):
    done = run_without("gradysim._netsim", folder, "keys", "*.transmitter.power")
    assert done.returncode == 0
    assert done.stdout.split("\t")[:3] == [
        "*.nodes[*].wlan[*].radio.transmitter.power",
        "mW",
        "20mW; 802.15.4: 2.24mW",
    ]
    assert "engine" in done.stderr
