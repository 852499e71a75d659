import shutil
import socket
import subprocess
import sys
import urllib.error
import urllib.request
import webbrowser
from urllib.parse import parse_qs, urlsplit

import pytest
from websockets.sync.client import connect

from gradysim.cli.app import main
from gradysim.prototype.run import PrototypeRun
from gradysim.replay.live import LiveView
from gradysim.replay.sink import ReplayWriter
from python.viewing import watched


@pytest.fixture
def folder(make_scenario, tmp_path, monkeypatch):
    make_scenario()
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("mode", ["integrated", "prototype"])
def test_a_run_is_shown_and_ends_when_its_viewers_have_left(folder, mode):
    end, code, _ = watched(f"gradysim view test.ini --mode {mode}", folder)
    assert end == {"time_s": pytest.approx(2.05), "complete": True}
    assert code == 0


def test_a_run_is_shown_at_a_published_address(folder):
    end, code, _ = watched("gradysim view test.ini --host 0.0.0.0", folder)
    assert end["complete"]
    assert code == 0


def test_a_host_that_is_not_of_this_machine_is_named(folder, capsys):
    assert main(["view", "test.ini", "--host", "192.0.2.1", "--no-browser"]) == 2
    assert "192.0.2.1" in capsys.readouterr().err


def test_a_failure_of_a_protocol_is_told_in_the_end(folder, make_scenario):
    make_scenario("class Tested(Talker):\n    def handle_packet(self, message): raise RuntimeError('spoilt')")
    end, code, error_output = watched("gradysim view test.ini", folder)
    assert end["complete"] is False
    assert code == 1
    assert "spoilt" in error_output


@pytest.mark.parametrize(
    ("port", "reason"), [("-1", "0 to 65535"), ("80000", "0 to 65535"), ("taken", "in use")]
)
def test_a_port_that_cannot_be_used_is_one_line(folder, capsys, port, reason):
    with socket.create_server(("127.0.0.1", 0)) as other:
        number = str(other.getsockname()[1]) if port == "taken" else port
        assert main(["view", "test.ini", "--port", number, "--no-browser"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert f"port {number}: " in line
    assert line.endswith(reason)


def test_the_browser_gets_an_address_without_the_token(folder, monkeypatch, capsys):
    opened = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    monkeypatch.setattr(LiveView, "wait_for_viewer", lambda *_: None)
    monkeypatch.setattr(LiveView, "wait_for_the_last", lambda *_: None)
    assert main(["view", "test.ini", "--mode", "prototype"]) == 0
    token = parse_qs(urlsplit(capsys.readouterr().out.strip()).query)["token"][0]
    (address,) = opened
    assert token not in address


@pytest.fixture
def replay(folder, make_scenario):
    """The file of a replay."""
    path = folder / "run.html"
    PrototypeRun(make_scenario(), replay=ReplayWriter(path)).execute()
    return path


def test_a_replay_is_opened_from_its_file(replay, capsys):
    assert main(["view", "run.html", "--no-browser"]) == 0
    assert capsys.readouterr() == (f"{replay.as_uri()}\n", "")


def test_a_replay_that_was_cut_is_said_to_be_incomplete(replay, capsys):
    replay.write_bytes(replay.read_bytes()[:-10])
    assert main(["view", "run.html", "--no-browser"]) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("run.html: ")


def test_replays_beside_each_other_are_served_while_somebody_watches(replay, folder):
    shutil.copy(replay, folder / "other.html")
    command = [sys.executable, "-m", "gradysim", "view", "run.html", "other.html", "--no-browser"]
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, text=True) as view:
        address = urlsplit(view.stdout.readline().strip())
        with connect(f"ws://{address.netloc}/viewer?{address.query}"):
            for path in ("/0", "/1"):
                with urllib.request.urlopen(f"http://{address.netloc}{path}?{address.query}") as answer:
                    assert answer.read() == replay.read_bytes()
            for path in ("/2", "/run.html", "/../run.html"):
                with pytest.raises(urllib.error.HTTPError) as refused:
                    urllib.request.urlopen(f"http://{address.netloc}{path}?{address.query}")
                assert refused.value.code == 404
                refused.value.close()
        assert view.wait(20) == 0


@pytest.mark.parametrize(
    "files", [["missing.html"], ["missing.ini"], ["test.ini", "test.ini"], ["protocol.html"], ["result.json"]]
)
def test_what_cannot_be_shown_is_a_mistake(folder, files, capsys):
    (folder / "protocol.html").write_text("<p>")
    (folder / "result.json").write_text("{}\n")
    assert main(["view", *files, "--no-browser"]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_a_replay_that_does_not_exist_is_answered_with_the_nearest_name(folder, capsys):
    (folder / "replay.html").write_text("<p>")
    assert main(["view", "replya.html", "--no-browser"]) == 2
    assert "`replay.html`" in capsys.readouterr().err
