from urllib.parse import urlsplit
from urllib.request import url2pathname

import pytest

from gradysim.cli.app import main
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


def test_a_replay_and_two_beside_each_other(folder, capsys):
    assert main(["run", "test.ini", "--replay", "all", "--quiet"]) == 0
    page = "results/General-#0.integrated.html"
    capsys.readouterr()
    assert main(["view", page, "--no-browser"]) == 0
    assert capsys.readouterr().out.strip() == (folder / page).as_uri()
    assert main(["view", page, page, "--no-browser"]) == 0
    beside = url2pathname(urlsplit(capsys.readouterr().out.strip()).path)
    with open(beside) as file:
        assert file.read().count((folder / page).as_uri()) == 2


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
    assert "did you mean `replay.html`?" in capsys.readouterr().err
