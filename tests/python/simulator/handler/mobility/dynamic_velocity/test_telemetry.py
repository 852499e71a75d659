from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.simulator.handler.mobility.dynamic_velocity.telemetry import DynamicVelocityTelemetry


def test_it_is_telemetry_with_a_velocity():
    telemetry = DynamicVelocityTelemetry(current_position=(1, 2, 3), current_velocity=(4, 5, 6))
    assert isinstance(telemetry, Telemetry)
    assert telemetry.current_velocity == (4, 5, 6)
