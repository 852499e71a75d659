// The UAV of ZigZag: examples/zigzag/mobile.py, which explains the protocol, in C++.
#pragma once

#include <cstdint>

#include "protocols/heartbeat_clock.hpp"
#include "protocols/parameter.hpp"
#include "protocols/reversing_mission.hpp"
#include "protocols/zigzag_custody.hpp"
#include "protocols/zigzag_message.hpp"

namespace netsim {

struct ZigZagMobileConfig {
    double heartbeat_interval_s = 1.0;   // > 0
    double heartbeat_jitter_s = 0.1;     // 0 … interval
    double interaction_timeout_s = 5.0;  // ≥ 0
    double launch_interval_s = 30.0;     // ≥ 0
    std::int64_t sensor_count = 5;       // ≥ 0
    double sensor_spacing_m = 300.0;
    double altitude_m = 20.0;
    double altitude_step_m = 1.0;
    double speed_mps = 10.0;  // ≥ 0

    void validate() const;
};

// Flies back and forth over the sensors, collects their readings and relays them to the ground
// station. Tracked: "data", readings that it holds; "collected", readings received from sensors;
// "interactions", number of exchanges.
class ZigZagMobileProtocol final : public Protocol {
public:
    ZigZagMobileProtocol(Node& node, const ZigZagMobileConfig& config);
    static NativeProtocol description();

    void check() const override { check_can_move(node_, "ZigZagMobileProtocol"); }
    void initialize() override;
    void handle_timer(const std::string& timer) override;
    void handle_packet(const Payload& message) override;
    void handle_telemetry(const Position& position) override { mission_.handle_telemetry(position); }
    void finish() override {}

private:
    void handle(const zigzag::SensorData& data);
    void handle(const zigzag::GroundHeartbeat& heartbeat);
    void handle(const zigzag::UavHeartbeat& heartbeat);
    void handle(const zigzag::PairRequest& request);
    void handle(const zigzag::PairConfirmation& confirmation);

    double launch_time_s() const;
    void launch();
    void send_heartbeat();
    NodeId carrier_of_pair(NodeId peer, bool peer_is_homeward) const;
    // Replies to a heartbeat of `peer`.
    void ask(NodeId peer, NodeId carrier);
    // Hands all data to `peer` if that is the carrier. Returns the total for the message to `peer`.
    std::int64_t hand_over(NodeId peer, NodeId carrier);
    // Ends an exchange: the carrier flies toward the ground station, the other one away from it.
    void part(NodeId carrier);
    void leave_others_alone();
    bool ignores_others() const;
    void track();

    Node& node_;
    ZigZagMobileConfig config_;
    ReversingMission mission_;
    HeartbeatClock heartbeats_;
    zigzag::Custody custody_;
    std::int64_t collected_ = 0;
    std::int64_t interactions_ = 0;
    double ignore_until_s_ = 0;
    bool launched_ = false;
};

}  // namespace netsim
