#include "netsim/node/link_budget.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "config/error_text.hpp"
#include "netsim/error.hpp"
#include "netsim/units.hpp"
#include "support/recorder.hpp"

namespace netsim {
namespace {

constexpr int payload_bytes = 90;  // as many as fit into a frame of 802.15.4

NodeConfig node(std::string_view interface_type = ieee80211_interface) {
    NodeConfig config("node", {std::string(interface_type)});
    config.mobility.telemetry_interval_s = 0;
    return config;
}

LinkBudget budget_of(const NodeConfig& config, const MediumConfig& medium = MediumConfig()) {
    return {medium, config, config, payload_bytes};
}

// Of `count` broadcasts over `range_m` in a run of the engine.
double ratio_in_a_run(const MediumConfig& medium, NodeConfig config, double range_m, int count) {
    Network network(medium, 1);
    test::Recorder& sender = test::add_recorder(network, config);
    config.initial_position.x = range_m;
    const test::Recorder& receiver = test::add_recorder(network, config);
    constexpr double interval_s = 0.1;
    sender.on_initialize = [count](test::Recorder& self) {
        for (int i = 0; i < count; ++i) {
            self.node.schedule_timer("send", SimTime::from_seconds(interval_s * i));
        }
    };
    sender.on_timer = [](test::Recorder& self, const std::string&) {
        self.broadcast(std::string(payload_bytes, '.'));
    };
    network.initialize();
    network.run_until(SimTime::from_seconds(interval_s * count + 1));
    return static_cast<double>(receiver.packets.size()) / count;
}

TEST(LinkBudget, OfDefaultsEndsAtTheSensitivity) {
    // Free space: 20 mW and -85 dBm.
    const double wavelength_m = speed_of_light_mps / 2.412e9;
    const double reach_m = wavelength_m / (4 * 3.14159265358979) * std::sqrt(0.02 / w_from_dbm(-85));
    const LinkBudget budget = budget_of(node());
    EXPECT_GT(budget.reception_ratio(reach_m * 0.9999, 0.02), 0.999);
    EXPECT_EQ(budget.reception_ratio(reach_m * 1.0001, 0.02), 0);
    EXPECT_NEAR(budget.tx_power_w_for(reach_m, 0.5), 0.02, 0.02 * 1e-6);
}

TEST(LinkBudget, ThePowerForARangeIsTheLeastThatDoes) {
    NodeConfig config = node();
    config.wlan[0].radio.sensitivity_w = 1e-20;  // noise decides
    config.wlan[0].radio.snir_threshold = 0;
    const LinkBudget budget = budget_of(config);
    for (const double range_m : {0.5, 50.0, 5000.0}) {
        for (const double ratio : {0.01, 0.5, 0.99}) {
            const double power_w = budget.tx_power_w_for(range_m, ratio);
            EXPECT_NEAR(budget.reception_ratio(range_m, power_w), ratio, 1e-6);
            EXPECT_LT(budget.reception_ratio(range_m, power_w * 0.9999), ratio);
        }
    }
}

struct Case {
    std::string path_loss;
    std::string_view interface_type;
};

class LinkBudgets : public testing::TestWithParam<Case> {};

TEST_P(LinkBudgets, ForetellWhatARunShows) {
    const bool narrowband = GetParam().interface_type == ieee802154_interface;
    MediumConfig medium{std::string(narrowband ? ieee802154_scalar_medium : ieee80211_scalar_medium)};
    medium.path_loss = GetParam().path_loss;
    medium.coherence_time_s = 0;  // each frame meets another state of the link
    NodeConfig config = node(GetParam().interface_type);
    config.initial_position.z = 10;
    config.wlan[0].radio.sensitivity_w = 1e-20;  // noise decides
    config.wlan[0].radio.snir_threshold = 0;
    const LinkBudget budget = budget_of(config, medium);
    constexpr double range_m = 60;
    config.wlan[0].radio.tx_power_w = budget.tx_power_w_for(range_m, 0.7);
    // Five standard errors of a share of 2000 frames, and as many of a mean over 2000 states.
    EXPECT_NEAR(ratio_in_a_run(medium, config, range_m, 2000),
                budget.reception_ratio(range_m, config.wlan[0].radio.tx_power_w), 0.07);
}

INSTANTIATE_TEST_SUITE_P(Models, LinkBudgets,
                         testing::Values(Case{"FreeSpacePathLoss", ieee80211_interface},
                                         Case{"RayleighFading", ieee80211_interface},
                                         Case{"LogNormalShadowing", ieee80211_interface},
                                         Case{"TwoRayInterference", ieee80211_interface},
                                         Case{"BreakpointPathLoss", ieee802154_interface},
                                         Case{"RicianFading", ieee802154_interface}),
                         [](const auto& tested) { return tested.param.path_loss; });

TEST(LinkBudget, AntennasHelpWithTheirLargestGain) {
    NodeConfig config = node();
    const double power_w = budget_of(config).tx_power_w_for(100, 0.5);
    config.wlan[0].radio.antenna.type_name = "ConstantGainAntenna";
    config.wlan[0].radio.antenna.gain = 2;
    EXPECT_NEAR(budget_of(config).tx_power_w_for(100, 0.5), power_w / 4, power_w * 1e-6);
}

TEST(LinkBudget, AMessageHasToFitIntoAFrame) {
    const MediumConfig medium;
    EXPECT_EQ(error_text([&] { LinkBudget(medium, node(), node(), 2277); }),
              "a message of 2277 B is too long: expected at most 2276 B, which mac.mtu_bytes = 2304 B leaves "
              "beside the headers of IPv4 and UDP");
    const NodeConfig narrowband = node(ieee802154_interface);
    EXPECT_EQ(error_text([&] { LinkBudget(medium, narrowband, narrowband, 91); }),
              "a message of 91 B is too long: expected at most 90 B, which a frame of 802.15.4 leaves beside "
              "the headers of IPv4 and UDP");
    EXPECT_EQ(error_text([&] { LinkBudget(medium, node(), node(), -1); }),
              "payload_bytes = -1 B: expected at least 0 B");
}

TEST(LinkBudget, RefusesWhatHasNoAnswer) {
    EXPECT_THROW(budget_of(node(), MediumConfig(std::string(unit_disk_medium))), ConfigError);
    NodeConfig elsewhere = node();
    elsewhere.wlan[0].radio.carrier_hz = 2.437e9;
    EXPECT_THROW(LinkBudget(MediumConfig(), node(), elsewhere, payload_bytes), ConfigError);
    NodeConfig of_another_mode = node();
    of_another_mode.wlan[0].mac.op_mode = "a";
    EXPECT_THROW(LinkBudget(MediumConfig(), node(), of_another_mode, payload_bytes), ConfigError);
    const LinkBudget budget = budget_of(node());
    EXPECT_THROW(budget.tx_power_w_for(-1, 0.5), ConfigError);
    EXPECT_THROW(budget.tx_power_w_for(50, 1), ConfigError);
    NodeConfig deaf = node();
    deaf.wlan[0].radio.antenna.type_name = "ConstantGainAntenna";
    deaf.wlan[0].radio.antenna.gain = 0;
    EXPECT_THROW(budget_of(deaf).tx_power_w_for(50, 0.5), ConfigError);
}

}  // namespace
}  // namespace netsim
