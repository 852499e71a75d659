#include "netsim/config/node_config.hpp"

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "config/error_text.hpp"

namespace netsim {
namespace {

TEST(NodeConfig, DefaultsAreValid) {
    EXPECT_NO_THROW(NodeConfig("uavs[0]").validate());
}

TEST(NodeConfig, NeedsAName) {
    EXPECT_EQ(error_text([] { NodeConfig("").validate(); }),
              "node.name = \"\": expected a name that is not empty");
}

TEST(NodeConfig, PositionMustBeInTheScene) {
    NodeConfig config("uavs[0]");
    config.initial_position.z = std::numeric_limits<double>::infinity();
    EXPECT_EQ(error_text([&] { config.validate(); }),
              "node.initial_position.z = inf m: expected from -10000000 m to 10000000 m");
}

TEST(NodeConfig, ChecksItsInterface) {
    NodeConfig config("uavs[0]");
    config.wlan[0].radio.tx_power_w = -1;
    EXPECT_EQ(error_text([&] { config.validate(); }),
              "radio.tx_power_w = -1 W: expected from 0 W to 1000000000000 W");
}

TEST(NodeConfig, SaysWhichOfSeveralInterfacesIsWrong) {
    NodeConfig config("relay", {std::string(ieee80211_interface), std::string(ieee802154_interface)});
    EXPECT_NO_THROW(config.validate());
    config.wlan[1].radio.tx_power_w = -1;
    EXPECT_EQ(error_text([&] { config.validate(); }),
              "wlan[1].radio.tx_power_w = -1 W: expected from 0 W to 1000000000000 W");
}

TEST(NodeConfig, HasAtLeastOneInterfaceAndNotTooMany) {
    EXPECT_EQ(error_text([] { NodeConfig("uavs[0]", {}).validate(); }),
              "node.wlan: 0 interfaces; expected 1 to 16");
    const std::vector<std::string> many(most_interfaces + 1, std::string(ieee80211_interface));
    EXPECT_EQ(error_text([&] { NodeConfig("uavs[0]", many).validate(); }),
              "node.wlan: 17 interfaces; expected 1 to 16");
}

TEST(NodeConfig, ChecksItsMobility) {
    NodeConfig config("uavs[0]");
    config.mobility.speed_mps = -1;
    EXPECT_EQ(error_text([&] { config.validate(); }), "mobility.speed_mps = -1 mps: expected at least 0 mps");
}

}  // namespace
}  // namespace netsim
