#include "protocols/zigzag_mobile_protocol.hpp"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include "netsim/config/check.hpp"

namespace netsim {

void ZigZagMobileConfig::validate() const {
    constexpr double max_sensors = 1e6;
    check_greater("protocol.heartbeat_interval", heartbeat_interval_s, 0, "s");
    check_between("protocol.heartbeat_jitter", heartbeat_jitter_s, 0, heartbeat_interval_s, "s");
    check_at_least("protocol.interaction_timeout", interaction_timeout_s, 0, "s");
    check_at_least("protocol.launch_interval", launch_interval_s, 0, "s");
    check_between("protocol.sensor_count", static_cast<double>(sensor_count), 0, max_sensors, "");
    check_finite("protocol.sensor_spacing", sensor_spacing_m, "m");
    check_finite("protocol.altitude", altitude_m, "m");
    check_finite("protocol.altitude_step", altitude_step_m, "m");
    check_at_least("protocol.speed", speed_mps, 0, "m/s");
}

ZigZagMobileProtocol::ZigZagMobileProtocol(Node& node, const ZigZagMobileConfig& config)
    : node_(node),
      config_(config),
      mission_(node, config.speed_mps),
      heartbeats_(config.heartbeat_interval_s, config.heartbeat_jitter_s, launch_time_s(), node.random()) {}

NativeProtocol ZigZagMobileProtocol::description() {
    using Config = ZigZagMobileConfig;
    return native_protocol<ZigZagMobileProtocol, Config>(
        "ZigZagMobileProtocol", "A UAV that relays the data of sensors to a ground station",
        "examples/zigzag/mobile.py:ZigZagMobile",
        {
            {"heartbeat_interval", &Config::heartbeat_interval_s, "s", "Time between two heartbeats"},
            {"heartbeat_jitter", &Config::heartbeat_jitter_s, "s", "Longest random delay of a heartbeat"},
            {"interaction_timeout", &Config::interaction_timeout_s, "s",
             "Time after launch or exchange in which others are ignored"},
            {"launch_interval", &Config::launch_interval_s, "s", "Time between the launches of two UAVs"},
            {"sensor_count", &Config::sensor_count, "", "Number of sensors, which stand on the x axis"},
            {"sensor_spacing", &Config::sensor_spacing_m, "m",
             "From x = 0 to the first sensor, and to the next"},
            {"altitude", &Config::altitude_m, "m", "Height at which UAV 0 flies"},
            {"altitude_step", &Config::altitude_step_m, "m",
             "By which each UAV flies higher than the one before"},
            {"speed", &Config::speed_mps, "mps", "Speed"},
        });
}

double ZigZagMobileProtocol::launch_time_s() const {
    return static_cast<double>(node_.id()) * config_.launch_interval_s;
}

void ZigZagMobileProtocol::initialize() {
    track();
    node_.schedule_timer("launch", SimTime::of_event(launch_time_s()));
}

void ZigZagMobileProtocol::handle_timer(const std::string& timer) {
    if (timer == "launch") {
        launch();
    } else {
        send_heartbeat();
    }
    node_.schedule_timer("heartbeat", heartbeats_.next());
}

void ZigZagMobileProtocol::handle_packet(const Payload& message) {
    if (!launched_) {
        return;
    }
    std::visit([this](const auto& decoded) { handle(decoded); }, zigzag::decode(*message));
    track();
}

void ZigZagMobileProtocol::handle(const zigzag::SensorData&) {
    custody_.add_reading();
    ++collected_;
}

void ZigZagMobileProtocol::handle(const zigzag::GroundHeartbeat& heartbeat) {
    ask(heartbeat.sender, heartbeat.sender);
}

void ZigZagMobileProtocol::handle(const zigzag::UavHeartbeat& heartbeat) {
    if (heartbeat.available) {
        ask(heartbeat.sender, carrier_of_pair(heartbeat.sender, heartbeat.homeward));
    }
}

void ZigZagMobileProtocol::handle(const zigzag::PairRequest& request) {
    custody_.take(request.sender, request.given);
    if (ignores_others()) {
        return;
    }
    const std::int64_t given = hand_over(request.sender, request.carrier);
    node_.send(request.sender, zigzag::encode(zigzag::PairConfirmation{node_.id(), request.carrier, given}));
    part(request.carrier);
}

void ZigZagMobileProtocol::handle(const zigzag::PairConfirmation& confirmation) {
    custody_.take(confirmation.sender, confirmation.given);
    if (!ignores_others()) {
        part(confirmation.carrier);
    }
}

void ZigZagMobileProtocol::launch() {
    const double height_m = config_.altitude_m + static_cast<double>(node_.id()) * config_.altitude_step_m;
    std::vector<Position> stops;
    for (std::int64_t stop = 0; stop <= config_.sensor_count; ++stop) {
        stops.push_back({static_cast<double>(stop) * config_.sensor_spacing_m, 0, height_m});
    }
    mission_.start(std::move(stops));
    launched_ = true;
    leave_others_alone();
}

void ZigZagMobileProtocol::send_heartbeat() {
    node_.broadcast(
        zigzag::encode(zigzag::UavHeartbeat{node_.id(), mission_.is_reversed(), !ignores_others()}));
}

NodeId ZigZagMobileProtocol::carrier_of_pair(NodeId peer, bool peer_is_homeward) const {
    // The one that flies outward; if both fly in the same direction, the one with the lower id.
    if (mission_.is_reversed() == peer_is_homeward) {
        return std::min(node_.id(), peer);
    }
    return mission_.is_reversed() ? peer : node_.id();
}

void ZigZagMobileProtocol::ask(NodeId peer, NodeId carrier) {
    if (ignores_others()) {
        return;
    }
    const std::int64_t given = hand_over(peer, carrier);
    node_.send(peer, zigzag::encode(zigzag::PairRequest{node_.id(), carrier, given}));
}

std::int64_t ZigZagMobileProtocol::hand_over(NodeId peer, NodeId carrier) {
    if (peer == carrier) {
        custody_.give_all(peer);
    }
    return custody_.given_to(peer);
}

void ZigZagMobileProtocol::part(NodeId carrier) {
    mission_.set_reversed(carrier == node_.id());
    leave_others_alone();
    ++interactions_;
}

void ZigZagMobileProtocol::leave_others_alone() {
    ignore_until_s_ = node_.now().seconds() + config_.interaction_timeout_s;
}

bool ZigZagMobileProtocol::ignores_others() const {
    return node_.now().seconds() < ignore_until_s_;
}

void ZigZagMobileProtocol::track() {
    TrackedVariables& tracked = node_.tracked_variables();
    tracked.set("data", custody_.held());
    tracked.set("collected", collected_);
    tracked.set("interactions", interactions_);
}

}  // namespace netsim
