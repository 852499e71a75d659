#include "beacon_network.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "netsim/kernel/random.hpp"

namespace {

using netsim::Node;
using netsim::NodeConfig;
using netsim::Payload;
using netsim::Position;
using netsim::SimTime;

constexpr netsim::Purpose scenario_draws{1002};

class Beacon final : public netsim::Protocol {
public:
    Beacon(Node& node, SimTime first, Payload text, double flight_area_m)
        : node_(node),
          next_(first),
          text_(std::move(text)),
          flight_area_m_(flight_area_m),
          draws_(2, static_cast<std::uint32_t>(node.id()), scenario_draws) {}

    void initialize() override { node_.schedule_timer("beacon", next_); }
    void handle_timer(const std::string&) override {
        node_.broadcast(text_);
        next_ += SimTime::from_us(1'000'000);
        node_.schedule_timer("beacon", next_);
        if (flight_area_m_ > 0 && draws_.uniform_int(10) == 0) {
            node_.go_to({draws_.uniform() * flight_area_m_, draws_.uniform() * flight_area_m_, 0});
        }
    }
    void handle_packet(const Payload&) override {}
    void handle_telemetry(const Position&) override {}
    void finish() override {}

private:
    Node& node_;
    SimTime next_;
    Payload text_;
    double flight_area_m_;
    netsim::RandomStream draws_;
};

}  // namespace

std::unique_ptr<netsim::Network> make_beacon_network(std::int64_t nodes, double speed_mps, double bitrate_bps,
                                                     double spread_s) {
    auto network = std::make_unique<netsim::Network>(netsim::MediumConfig(), 1);
    netsim::RandomStream draws(1, 0, scenario_draws);
    const double side_m = 100 * std::sqrt(static_cast<double>(nodes));
    const auto text = std::make_shared<const std::string>(100, 'x');
    for (std::int64_t i = 0; i < nodes; ++i) {
        NodeConfig config("node " + std::to_string(i));
        config.initial_position = {draws.uniform() * side_m, draws.uniform() * side_m, 0};
        config.wlan[0].radio.tx_power_w = 0.002;
        config.wlan[0].mac.bitrate_bps = bitrate_bps;
        config.mobility.speed_mps = speed_mps;
        config.mobility.telemetry_interval_s = 0;
        Node& node = network->add_node(config);
        node.set_protocol(std::make_unique<Beacon>(node, SimTime::from_seconds(draws.uniform() * spread_s),
                                                   text, speed_mps > 0 ? side_m : 0));
    }
    network->initialize();
    return network;
}
