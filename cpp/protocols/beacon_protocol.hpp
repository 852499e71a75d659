// A node that broadcasts periodically and counts what it receives: examples/reference/beacon.py in
// C++.
#pragma once

#include <cstdint>

#include "netsim/kernel/prefetch.hpp"
#include "protocols/parameter.hpp"

namespace netsim {

struct BeaconConfig {
    double first_send_s = 1.0;  // ≥ 0
    double spread_s = 0.0;      // ≥ 0
    double interval_s = 1.0;    // > 0
    double stop_s = 60.9;
    std::int64_t payload_bytes = 100;  // ≥ 0, at most what the node can send

    void validate() const;
};

// Message k = 0, 1, … is sent at first_send + offset + k · interval, if that is before stop. The
// offset is drawn at the start, between 0 and spread. Tracked at the end: "sent", "received".
class alignas(64) BeaconProtocol final : public Protocol {
public:
    BeaconProtocol(Node& node, const BeaconConfig& config);
    static NativeProtocol description();

    void initialize() override;
    void handle_timer(const std::string& timer) override;
    void handle_packet(const Payload&) override { ++received_; }
    void handle_telemetry(const Position&) override {}
    void finish() override;
    void prefetch() const override { netsim::prefetch(*message_); }

private:
    void schedule();

    // The members that every received message reads come first: the cache line that the medium
    // prefetches.
    std::int64_t received_ = 0;
    std::int64_t sent_ = 0;
    double start_s_ = 0;
    Node& node_;
    Payload message_;
    BeaconConfig config_;
};

}  // namespace netsim
