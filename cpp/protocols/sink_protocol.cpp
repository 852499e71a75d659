#include "protocols/sink_protocol.hpp"

#include <algorithm>
#include <string>

#include "netsim/config/check.hpp"

namespace netsim {

namespace {

// The length in characters, as in Python: the UTF-8 bytes that are not continuation bytes.
std::int64_t characters(const std::string& text) {
    return std::count_if(text.begin(), text.end(),
                         [](char octet) { return (static_cast<unsigned char>(octet) & 0xC0U) != 0x80U; });
}

}  // namespace

void SinkConfig::validate() const {
    check_finite("protocol.count_from", count_from_s, "s");
}

NativeProtocol SinkProtocol::description() {
    return native_protocol<SinkProtocol, SinkConfig>(
        "SinkProtocol", "Counts the messages that arrive", "examples/reference/sink.py:Sink",
        {{"count_from", &SinkConfig::count_from_s, "s", "What arrives before is left out"}});
}

void SinkProtocol::handle_packet(const Payload& message) {
    if (node_.now().seconds() >= config_.count_from_s) {
        ++received_;
        received_bytes_ += characters(*message);
    }
}

void SinkProtocol::finish() {
    node_.tracked_variables().set("received", received_);
    node_.tracked_variables().set("received_bytes", received_bytes_);
}

}  // namespace netsim
