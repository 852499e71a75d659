// Flooding: a message reaches all nodes of a network, relayed by each of them once.
// examples/reference/flood.py in C++.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "protocols/parameter.hpp"

namespace netsim {

struct FloodConfig {
    std::int64_t origin = 0;    // a node's id
    double first_send_s = 1.0;  // ≥ 0
    double interval_s = 1.0;    // > 0
    double stop_s = 60.9;
    double jitter_s = 0.01;            // ≥ 0
    std::int64_t hop_limit = 16;       // ≥ 1
    std::int64_t payload_bytes = 100;  // ≥ 0, at most what the node can send

    void validate() const;
};

// A message is "NUMBER HOPS ", padded with x to payload_bytes. HOPS is 1 from the origin and grows
// by 1 with each relay. Tracked: "sent", "received" (each message once), "duplicates", "relayed",
// "most_hops".
class FloodProtocol final : public Protocol {
public:
    FloodProtocol(Node& node, const FloodConfig& config) : node_(node), config_(config) {}
    static NativeProtocol description();

    void check() const override { check_node_id(node_, "protocol.origin", config_.origin); }
    void initialize() override;
    void handle_timer(const std::string& timer) override;
    void handle_packet(const Payload& message) override;
    void handle_telemetry(const Position&) override {}
    void finish() override;

private:
    void schedule();
    std::string text(std::int64_t number, std::int64_t hops) const;

    Node& node_;
    FloodConfig config_;
    std::set<std::int64_t> known_;
    std::int64_t sent_ = 0;
    std::int64_t received_ = 0;
    std::int64_t duplicates_ = 0;
    std::int64_t relayed_ = 0;
    std::int64_t max_hops_ = 0;
};

}  // namespace netsim
