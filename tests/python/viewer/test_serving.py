import pytest
from websockets.datastructures import Headers
from websockets.http11 import Request

from gradysim.viewer.serving import LOOPBACK_NAMES, Host, is_allowed

SITE = "https://example.org"


def request(host, origin=None):
    headers = Headers({"Host": host} if host else {})
    if origin is not None:
        headers["Origin"] = origin
    return Request("/", headers)


@pytest.mark.parametrize("host", ["localhost:5678", "127.0.0.1:5678", "[::1]:5678", "localhost"])
def test_scripts_and_the_own_page_are_allowed(host):
    assert is_allowed(request(host))
    assert is_allowed(request(host, f"http://{host}"))


@pytest.mark.parametrize("host", ["", "example.org:5678", "localhost.example.org:5678", "192.168.0.2:5678"])
def test_other_names_of_this_machine_are_allowed_only_if_asked_for(host):
    assert not is_allowed(request(host))
    assert is_allowed(request(host), names=None)


@pytest.mark.parametrize(
    "origin", ["", "null", SITE, "http://localhost", "http://localhost:80", "https://localhost:5678"]
)
def test_other_sites_are_allowed_only_by_name(origin):
    assert not is_allowed(request("localhost:5678", origin))
    assert not is_allowed(request("example.org:5678", origin), names=None)
    assert is_allowed(request("localhost:5678", origin), origins=[origin])


@pytest.mark.parametrize(
    ("host", "name"), [("127.0.0.1", "127.0.0.1"), ("localhost", "localhost"), ("::1", "[::1]")]
)
def test_a_server_of_this_machine_accepts_only_names_of_this_machine(host, name):
    assert Host(host).name == name
    assert Host(host).accepted == LOOPBACK_NAMES


@pytest.mark.parametrize(
    ("host", "name"),
    [("0.0.0.0", "localhost"), ("::", "localhost"), ("", "localhost"), ("192.168.0.2", "192.168.0.2")],
)
def test_a_server_of_a_network_accepts_all_names(host, name):
    assert Host(host).name == name
    assert Host(host).accepted is None
