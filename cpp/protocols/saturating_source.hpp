// A node that always has something to send: examples/reference/saturating_source.py in C++.
#pragma once

#include <cstdint>

#include "protocols/parameter.hpp"

namespace netsim {

struct SaturatingSourceConfig {
    std::int64_t destination = 0;       // a node's id
    std::int64_t payload_bytes = 1000;  // ≥ 0, at most what the node can send
    std::int64_t burst = 4;             // ≥ 1
    double interval_s = 0.001;          // > 0
    double spread_s = 0;                // ≥ 0

    void validate() const;
};

// It periodically passes a burst of messages to its MAC, faster than the channel can carry them, so
// that the queue never becomes empty. The default offered load is 32 Mbps of payload. The time of the
// first burst is drawn at the start, between 0 and spread.
class SaturatingSource final : public Protocol {
public:
    SaturatingSource(Node& node, const SaturatingSourceConfig& config);
    static NativeProtocol description();

    void check() const override { check_other_node_id(node_, "protocol.destination", config_.destination); }
    void initialize() override;
    void handle_timer(const std::string& timer) override;
    void handle_packet(const Payload&) override {}
    void handle_telemetry(const Position&) override {}
    void finish() override {}

private:
    Node& node_;
    SaturatingSourceConfig config_;
    Payload message_;
    double start_s_ = 0;
    std::int64_t bursts_ = 0;
};

}  // namespace netsim
