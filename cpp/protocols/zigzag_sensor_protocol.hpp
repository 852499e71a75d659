// The sensor of ZigZag: examples/zigzag/sensor.py in C++.
#pragma once

#include <cstdint>

#include "protocols/parameter.hpp"

namespace netsim {

struct ZigZagSensorConfig {
    void validate() const {}
};

// Stands still and replies to each heartbeat of a UAV with a reading. Tracked: "answered", readings
// sent so far.
class ZigZagSensorProtocol final : public Protocol {
public:
    ZigZagSensorProtocol(Node& node, const ZigZagSensorConfig&) : node_(node) {}
    static NativeProtocol description();

    void initialize() override;
    void handle_timer(const std::string&) override {}
    void handle_packet(const Payload& message) override;
    void handle_telemetry(const Position&) override {}
    void finish() override {}

private:
    Node& node_;
    std::int64_t answered_ = 0;
};

}  // namespace netsim
