#include "protocols/beacon_protocol.hpp"

#include <string>

#include "netsim/config/check.hpp"

namespace netsim {

void BeaconConfig::validate() const {
    check_at_least("protocol.first_send", first_send_s, 0, "s");
    check_at_least("protocol.spread", spread_s, 0, "s");
    check_greater("protocol.interval", interval_s, 0, "s");
    check_finite("protocol.stop", stop_s, "s");
}

BeaconProtocol::BeaconProtocol(Node& node, const BeaconConfig& config)
    : node_(node), message_(node.padding(config.payload_bytes)), config_(config) {}

NativeProtocol BeaconProtocol::description() {
    using Config = BeaconConfig;
    return native_protocol<BeaconProtocol, Config>(
        "BeaconProtocol", "Broadcasts at regular times and counts what it hears",
        "examples/reference/beacon.py:Beacon",
        {
            {"first_send", &Config::first_send_s, "s", "Time of the first message, without its offset"},
            {"spread", &Config::spread_s, "s", "Longest offset, which is drawn once for each node"},
            {"interval", &Config::interval_s, "s", "Time between two messages"},
            {"stop", &Config::stop_s, "s", "Nothing is sent from this time on"},
            {"payload_bytes", &Config::payload_bytes, "B", "Size of a message"},
        });
}

void BeaconProtocol::initialize() {
    start_s_ = config_.first_send_s + node_.random().uniform(0, config_.spread_s);
    schedule();
}

void BeaconProtocol::schedule() {
    // Multiplied, not accumulated: all nodes round equally, and errors do not grow.
    const double time_s = start_s_ + static_cast<double>(sent_) * config_.interval_s;
    if (time_s < config_.stop_s) {
        node_.schedule_timer("beacon", SimTime::of_event(time_s));
    }
}

void BeaconProtocol::handle_timer(const std::string&) {
    node_.broadcast(message_);
    ++sent_;
    schedule();
}

void BeaconProtocol::finish() {
    node_.tracked_variables().set("sent", sent_);
    node_.tracked_variables().set("received", received_);
}

}  // namespace netsim
