#include "protocols/zigzag_ground_station_protocol.hpp"

#include <variant>

#include "netsim/config/check.hpp"

namespace netsim {

void ZigZagGroundStationConfig::validate() const {
    check_greater("protocol.heartbeat_interval", heartbeat_interval_s, 0, "s");
    check_between("protocol.heartbeat_jitter", heartbeat_jitter_s, 0, heartbeat_interval_s, "s");
}

ZigZagGroundStationProtocol::ZigZagGroundStationProtocol(Node& node, const ZigZagGroundStationConfig& config)
    : node_(node), heartbeats_(config.heartbeat_interval_s, config.heartbeat_jitter_s, 0, node.random()) {}

NativeProtocol ZigZagGroundStationProtocol::description() {
    using Config = ZigZagGroundStationConfig;
    return native_protocol<ZigZagGroundStationProtocol, Config>(
        "ZigZagGroundStationProtocol", "Takes the data of each UAV that comes by",
        "examples/zigzag/ground_station.py:ZigZagGroundStation",
        {
            {"heartbeat_interval", &Config::heartbeat_interval_s, "s", "Time between two heartbeats"},
            {"heartbeat_jitter", &Config::heartbeat_jitter_s, "s", "Longest random delay of a heartbeat"},
        });
}

void ZigZagGroundStationProtocol::initialize() {
    track();
    node_.schedule_timer("heartbeat", heartbeats_.next());
}

void ZigZagGroundStationProtocol::handle_timer(const std::string&) {
    node_.broadcast(zigzag::encode(zigzag::GroundHeartbeat{node_.id()}));
    node_.schedule_timer("heartbeat", heartbeats_.next());
}

void ZigZagGroundStationProtocol::handle_packet(const Payload& message) {
    const NodeId me = node_.id();
    const zigzag::Message decoded = zigzag::decode(*message);
    if (const auto* heartbeat = std::get_if<zigzag::UavHeartbeat>(&decoded)) {
        if (heartbeat->available) {
            node_.send(heartbeat->sender, zigzag::encode(zigzag::PairRequest{me, me, 0}));
        }
    } else if (const auto* request = std::get_if<zigzag::PairRequest>(&decoded)) {
        take(request->sender, request->given);
        node_.send(request->sender, zigzag::encode(zigzag::PairConfirmation{me, me, 0}));
    } else if (const auto* confirmation = std::get_if<zigzag::PairConfirmation>(&decoded)) {
        take(confirmation->sender, confirmation->given);
    }
}

void ZigZagGroundStationProtocol::take(NodeId uav, std::int64_t given) {
    if (custody_.take(uav, given) > 0) {
        ++deliveries_;
        track();
    }
}

void ZigZagGroundStationProtocol::track() {
    node_.tracked_variables().set("data", custody_.held());
    node_.tracked_variables().set("deliveries", deliveries_);
}

}  // namespace netsim
