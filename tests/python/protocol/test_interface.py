import pytest

from gradysim.protocol.errors import CommunicationException
from gradysim.protocol.interface import IProtocol, IProvider, is_protocol_class
from python.quiet_protocol import Quiet


class SilentProvider(IProvider):
    """A user's provider with only the abstract methods."""

    def __init__(self, node_id=0):
        self.node_id = node_id

    def send_communication_command(self, command):
        pass

    def send_mobility_command(self, command):
        pass

    def schedule_timer(self, timer, timestamp):
        pass

    def cancel_timer(self, timer):
        pass

    def current_time(self):
        return 0.0

    def get_id(self):
        return self.node_id


def test_instantiate_gives_the_protocol_its_provider():
    provider = SilentProvider()
    assert Quiet.instantiate(provider).provider is provider


def test_the_constructor_runs_before_there_is_a_provider():
    class Curious(Quiet):
        def __init__(self):
            self.had_provider = hasattr(self, "provider")

    assert Curious.instantiate(SilentProvider()).had_provider is False


@pytest.mark.parametrize("missing", ["initialize", "handle_timer", "handle_packet"])
def test_a_protocol_must_have_every_required_callback(missing):
    methods = {name: (lambda self, *arguments: None) for name in vars(Quiet) if name[0] != "_"}
    del methods[missing]
    incomplete = type("Incomplete", (IProtocol,), methods)
    with pytest.raises(TypeError, match=missing):
        incomplete()


def test_a_protocol_may_leave_out_the_others():
    methods = dict.fromkeys(("initialize", "handle_timer", "handle_packet"), lambda self, *arguments: None)
    complete = type("Complete", (IProtocol,), methods)()
    complete.handle_telemetry(None)
    complete.finish()


def test_the_interface_itself_is_not_a_protocol():
    assert not is_protocol_class(IProtocol)


def test_a_provider_that_knows_no_names_says_so():
    with pytest.raises(CommunicationException, match="'base'"):
        SilentProvider().id_of("base")


def test_a_provider_that_knows_no_runs_has_no_name_for_them():
    assert SilentProvider().run_name == ""


def test_a_provider_without_a_stream_of_its_own_has_one_by_id():
    def draws(node_id):
        return [SilentProvider(node_id).random.random() for _ in range(2)]

    assert draws(1)[0] == draws(1)[1]
    assert draws(1) != draws(2)


def test_the_default_stream_goes_on_where_it_was():
    provider = SilentProvider()
    assert provider.random.random() != provider.random.random()
