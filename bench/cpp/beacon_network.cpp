#include "beacon_network.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "netsim/kernel/random.hpp"
#include "protocols/beacon_protocol.hpp"

namespace {

using netsim::BeaconConfig;
using netsim::BeaconProtocol;
using netsim::Node;
using netsim::NodeConfig;
using netsim::Payload;
using netsim::Position;

constexpr netsim::Purpose scenario_draws{1002};
constexpr netsim::Purpose flight_draws{1003};

// The engine's beacons. One beacon in ten makes the node fly to another place.
class FlyingBeacon final : public netsim::Protocol {
public:
    FlyingBeacon(Node& node, const BeaconConfig& config, double flight_area_m, std::uint64_t seed)
        : beacon_(node, config),
          node_(node),
          flight_area_m_(flight_area_m),
          draws_(seed, static_cast<std::uint32_t>(node.id()), flight_draws) {}

    void initialize() override { beacon_.initialize(); }
    void handle_timer(const std::string& timer) override {
        beacon_.handle_timer(timer);
        if (draws_.uniform_int(10) == 0) {
            node_.go_to({draws_.uniform() * flight_area_m_, draws_.uniform() * flight_area_m_, 0});
        }
    }
    void handle_packet(const Payload& message) override { beacon_.handle_packet(message); }
    void handle_telemetry(const Position&) override {}
    void finish() override { beacon_.finish(); }

private:
    BeaconProtocol beacon_;
    Node& node_;
    double flight_area_m_;
    netsim::RandomStream draws_;
};

}  // namespace

std::unique_ptr<netsim::Network> make_beacon_network(std::int64_t nodes, double speed_mps, double bitrate_bps,
                                                     double spread_s, std::uint64_t seed) {
    auto network = std::make_unique<netsim::Network>(netsim::MediumConfig(), seed);
    netsim::RandomStream draws(seed, 0, scenario_draws);
    const double side_m = 100 * std::sqrt(static_cast<double>(nodes));
    BeaconConfig beacons;
    beacons.first_send_s = 0;
    beacons.spread_s = spread_s;
    beacons.stop_s = std::numeric_limits<double>::max();
    for (std::int64_t i = 0; i < nodes; ++i) {
        NodeConfig config("node " + std::to_string(i));
        config.initial_position = {draws.uniform() * side_m, draws.uniform() * side_m, 0};
        config.wlan[0].radio.tx_power_w = 0.002;
        config.wlan[0].mac.bitrate_bps = bitrate_bps;
        config.mobility.speed_mps = speed_mps;
        config.mobility.telemetry_interval_s = 0;
        Node& node = network->add_node(config);
        if (speed_mps > 0) {
            node.set_protocol(std::make_unique<FlyingBeacon>(node, beacons, side_m, seed));
        } else {
            node.set_protocol(std::make_unique<BeaconProtocol>(node, beacons));
        }
    }
    network->initialize();
    return network;
}
