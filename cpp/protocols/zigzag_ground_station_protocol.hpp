// The ground station of ZigZag: examples/zigzag/ground_station.py in C++.
#pragma once

#include <cstdint>

#include "protocols/heartbeat_clock.hpp"
#include "protocols/parameter.hpp"
#include "protocols/zigzag_custody.hpp"
#include "protocols/zigzag_message.hpp"

namespace netsim {

struct ZigZagGroundStationConfig {
    double heartbeat_interval_s = 1.0;  // > 0
    double heartbeat_jitter_s = 0.1;    // 0 … interval

    void validate() const;
};

// Stands still and takes all data of each UAV that passes. The UAV then flies away from it. Tracked:
// "data", readings received; "deliveries", how often a UAV delivered any.
class ZigZagGroundStationProtocol final : public Protocol {
public:
    ZigZagGroundStationProtocol(Node& node, const ZigZagGroundStationConfig& config);
    static NativeProtocol description();

    void initialize() override;
    void handle_timer(const std::string& timer) override;
    void handle_packet(const Payload& message) override;
    void handle_telemetry(const Position&) override {}
    void finish() override {}

private:
    void take(NodeId uav, std::int64_t given);
    void track();

    Node& node_;
    HeartbeatClock heartbeats_;
    zigzag::Custody custody_;
    std::int64_t deliveries_ = 0;
};

}  // namespace netsim
