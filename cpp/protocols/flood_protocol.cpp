#include "protocols/flood_protocol.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

#include "netsim/config/check.hpp"
#include "netsim/error.hpp"

namespace netsim {

namespace {

constexpr std::string_view origin_timer = "flood";

// Removes an integer and the space after it from the front of `rest`.
bool take_number(std::string_view& rest, std::int64_t& number) {
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    if (error != std::errc() || end == rest.data() + rest.size() || *end != ' ') {
        return false;
    }
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()) + 1);
    return true;
}

}  // namespace

void FloodConfig::validate() const {
    constexpr double most = std::numeric_limits<NodeId>::max();
    check_between("protocol.origin", static_cast<double>(origin), 0, most, "");
    check_at_least("protocol.first_send", first_send_s, 0, "s");
    check_greater("protocol.interval", interval_s, 0, "s");
    check_finite("protocol.stop", stop_s, "s");
    check_at_least("protocol.jitter", jitter_s, 0, "s");
    check_between("protocol.hop_limit", static_cast<double>(hop_limit), 1, most, "");
}

NativeProtocol FloodProtocol::description() {
    using Config = FloodConfig;
    return native_protocol<FloodProtocol, Config>(
        "FloodProtocol", "Messages of one node, which every other node relays once",
        "examples/reference/flood.py:Flood",
        {
            {"origin", &Config::origin, "", "Id of the node that the messages come from"},
            {"first_send", &Config::first_send_s, "s", "Time of the first message"},
            {"interval", &Config::interval_s, "s", "Time between two messages of the origin"},
            {"stop", &Config::stop_s, "s", "The origin sends nothing from this time on"},
            {"jitter", &Config::jitter_s, "s", "Longest delay of a relay, which is drawn for each"},
            {"hop_limit", &Config::hop_limit, "",
             "Transmissions in a row after which a message is not relayed"},
            {"payload_bytes", &Config::payload_bytes, "B", "Size of a message; longer if its numbers are"},
        });
}

void FloodProtocol::initialize() {
    if (node_.id() == config_.origin) {
        schedule();
    }
}

void FloodProtocol::schedule() {
    const double time_s = config_.first_send_s + static_cast<double>(sent_) * config_.interval_s;
    if (time_s < config_.stop_s) {
        node_.schedule_timer(std::string(origin_timer), SimTime::of_event(time_s));
    }
}

std::string FloodProtocol::text(std::int64_t number, std::int64_t hops) const {
    std::string text = std::to_string(number) + " " + std::to_string(hops) + " ";
    text.resize(std::max(text.size(), static_cast<std::size_t>(config_.payload_bytes)), 'x');
    return text;
}

void FloodProtocol::handle_timer(const std::string& timer) {
    if (timer != origin_timer) {  // the timer is named after the message to relay
        node_.broadcast(std::make_shared<const std::string>(timer));
        ++relayed_;
        return;
    }
    known_.insert(sent_);
    node_.broadcast(std::make_shared<const std::string>(text(sent_, 1)));
    ++sent_;
    schedule();
}

void FloodProtocol::handle_packet(const Payload& message) {
    std::string_view rest = *message;
    std::int64_t number = 0;
    std::int64_t hops = 0;
    if (!take_number(rest, number) || !take_number(rest, hops)) {
        throw SimulationError("not a message of FloodProtocol: '" + *message + "'");
    }
    if (!known_.insert(number).second) {
        ++duplicates_;
        return;
    }
    ++received_;
    max_hops_ = std::max(max_hops_, hops);
    if (hops < config_.hop_limit) {
        const double time_s = node_.now().seconds() + node_.random().uniform(0, config_.jitter_s);
        node_.schedule_timer(text(number, hops + 1), SimTime::of_event(time_s, node_.now()));
    }
}

void FloodProtocol::finish() {
    const std::pair<std::string_view, std::int64_t> counts[] = {
        {"sent", sent_},       {"received", received_},  {"duplicates", duplicates_},
        {"relayed", relayed_}, {"most_hops", max_hops_},
    };
    for (const auto& [name, count] : counts) {
        node_.tracked_variables().set(name, count);
    }
}

}  // namespace netsim
