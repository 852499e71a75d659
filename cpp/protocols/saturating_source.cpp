#include "protocols/saturating_source.hpp"

#include <limits>
#include <string>

#include "netsim/config/check.hpp"

namespace netsim {

void SaturatingSourceConfig::validate() const {
    constexpr double most = std::numeric_limits<NodeId>::max();
    check_between("protocol.destination", static_cast<double>(destination), 0, most, "");
    check_between("protocol.burst", static_cast<double>(burst), 1, most, "");
    check_greater("protocol.interval", interval_s, 0, "s");
    check_at_least("protocol.spread", spread_s, 0, "s");
}

SaturatingSource::SaturatingSource(Node& node, const SaturatingSourceConfig& config)
    : node_(node), config_(config), message_(node.padding(config.payload_bytes)) {}

NativeProtocol SaturatingSource::description() {
    using Config = SaturatingSourceConfig;
    return native_protocol<SaturatingSource, Config>(
        "SaturatingSource", "Sends to one node, faster than the channel can carry it",
        "examples/reference/saturating_source.py:SaturatingSource",
        {
            {"destination", &Config::destination, "", "Id of the node that the messages go to"},
            {"payload_bytes", &Config::payload_bytes, "B", "Size of a message"},
            {"burst", &Config::burst, "", "Messages handed over at once"},
            {"interval", &Config::interval_s, "s", "Time between two bursts"},
            {"spread", &Config::spread_s, "s",
             "Latest time of the first burst, which is drawn for each node"},
        });
}

void SaturatingSource::initialize() {
    start_s_ = node_.random().uniform(0, config_.spread_s);
    node_.schedule_timer("burst", SimTime::of_event(start_s_));
}

void SaturatingSource::handle_timer(const std::string&) {
    for (std::int64_t i = 0; i < config_.burst; ++i) {
        node_.send(static_cast<NodeId>(config_.destination), message_);
    }
    ++bursts_;
    const double time_s = start_s_ + static_cast<double>(bursts_) * config_.interval_s;
    node_.schedule_timer("burst", SimTime::of_event(time_s));
}

}  // namespace netsim
