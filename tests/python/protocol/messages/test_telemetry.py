from gradysim.protocol.messages.telemetry import Telemetry


def test_telemetry_holds_the_position():
    assert Telemetry(current_position=(1.0, 2.0, 3.0)).current_position == (1.0, 2.0, 3.0)
