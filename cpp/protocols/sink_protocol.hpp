// A node that counts received messages: examples/reference/sink.py in C++.
#pragma once

#include <cstdint>

#include "protocols/parameter.hpp"

namespace netsim {

struct SinkConfig {
    double count_from_s = 0.0;

    void validate() const;
};

// Tracked at the end, for messages at or after `count_from`: "received" and "received_bytes", the
// number of characters.
class alignas(64) SinkProtocol final : public Protocol {
public:
    SinkProtocol(Node& node, const SinkConfig& config) : node_(node), config_(config) {}
    static NativeProtocol description();

    void initialize() override {}
    void handle_timer(const std::string&) override {}
    void handle_packet(const Payload& message) override;
    void handle_telemetry(const Position&) override {}
    void finish() override;

private:
    Node& node_;
    SinkConfig config_;
    std::int64_t received_ = 0;
    std::int64_t received_bytes_ = 0;
};

}  // namespace netsim
