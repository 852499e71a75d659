"""The server of several replays side by side, with real connections. Their files need not be replays here."""

import socket
import time
from http.client import HTTPConnection
from urllib.parse import urlsplit

import pytest

from gradysim.replay.beside import ReplaysBeside, short_names


@pytest.fixture
def files(tmp_path):
    files = [tmp_path / "a.html", tmp_path / "b.html"]
    for file in files:
        file.write_text(file.name)
    return files


@pytest.fixture
def server(files):
    with ReplaysBeside(files) as server:
        yield server


def response(server, path, **headers):
    """Return the response to a request of the page at a path, and its body."""
    connection = HTTPConnection("127.0.0.1", server.port)
    connection.request("GET", f"{path}?{urlsplit(server.address).query}", headers=headers)
    answer = connection.getresponse()
    return answer, answer.read().decode()


def test_a_replay_that_is_shown_alone_cannot_reach_the_others(server):
    answer, text = response(server, "/1")
    assert text == "b.html"
    policy, *allowed = answer.getheader("Content-Security-Policy").split()
    assert policy == "sandbox"
    assert "allow-same-origin" not in allowed


def test_the_page_is_not_in_a_sandbox(server):
    answer, _ = response(server, "/")
    assert answer.getheader("Content-Security-Policy") is None


def test_a_page_in_a_sandbox_gets_no_replay(server):
    answer, text = response(server, "/1", Origin="null")
    assert answer.status == 403
    assert "b.html" not in text


@pytest.mark.parametrize("path", ["/2", "/-1", "/%31", "//1", "/1/", "/../a.html", "/a.html"])
def test_there_are_no_other_files(server, path):
    assert response(server, path)[0].status == 404


def test_a_file_that_is_gone_is_not_found(server, files):
    files[1].unlink()
    assert response(server, "/1")[0].status == 404


@pytest.mark.verify
def test_a_slow_download_is_not_cut(server, files):
    size = 30_000_000  # more than buffers hold
    files[0].write_bytes(bytes(size))
    with socket.create_connection(("127.0.0.1", server.port)) as connection:
        query = urlsplit(server.address).query
        connection.sendall(f"GET /0?{query} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        time.sleep(12)  # libraries have a limit of 10 s
        received = sum(len(part) for part in iter(lambda: connection.recv(1_000_000), b""))
    assert received > size


def test_files_of_equal_names_are_named_by_their_directories(tmp_path):
    (first, second) = files = [tmp_path / name / "run.html" for name in ("first", "second")]
    assert short_names(files) == ["first/run.html", "second/run.html"]
    assert short_names([first]) == ["run.html"]
    assert short_names([second, second]) == ["run.html", "run.html"]
