#include "protocols/zigzag_sensor_protocol.hpp"

#include <variant>

#include "protocols/zigzag_message.hpp"

namespace netsim {

NativeProtocol ZigZagSensorProtocol::description() {
    return native_protocol<ZigZagSensorProtocol, ZigZagSensorConfig>(
        "ZigZagSensorProtocol", "Answers the heartbeats of UAVs with readings",
        "examples/zigzag/sensor.py:ZigZagSensor", {});
}

void ZigZagSensorProtocol::initialize() {
    node_.tracked_variables().set("answered", answered_);
}

void ZigZagSensorProtocol::handle_packet(const Payload& message) {
    const zigzag::Message decoded = zigzag::decode(*message);
    if (const auto* heartbeat = std::get_if<zigzag::UavHeartbeat>(&decoded)) {
        node_.send(heartbeat->sender, zigzag::encode(zigzag::SensorData{node_.id()}));
        ++answered_;
        node_.tracked_variables().set("answered", answered_);
    }
}

}  // namespace netsim
