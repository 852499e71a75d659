#include "netsim/config/node_config.hpp"

#include <limits>
#include <string>

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

TEST(NodeConfig, ChecksItsRadio) {
    NodeConfig config("uavs[0]");
    config.radio.tx_power_w = -1;
    EXPECT_EQ(error_text([&] { config.validate(); }), "radio.tx_power_w = -1 W: expected at least 0 W");
}

TEST(NodeConfig, ChecksItsMac) {
    NodeConfig config("uavs[0]");
    config.mac.short_retry_limit = 0;
    EXPECT_EQ(error_text([&] { config.validate(); }), "mac.short_retry_limit = 0: expected from 1 to 255");
}

TEST(NodeConfig, ItsInterfaceSetsTheDefaultsOfTheRadio) {
    const NodeConfig config("sensors[0]", std::string(ieee802154_interface));
    EXPECT_EQ(config.radio.carrier_hz, 2.45e9);
    EXPECT_NO_THROW(config.validate());
}

TEST(NodeConfig, ChecksItsCsma) {
    NodeConfig config("sensors[0]");
    config.csma.min_be = -1;
    EXPECT_EQ(error_text([&] { config.validate(); }), "csma.min_be = -1: expected from 0 to 5");
}

TEST(NodeConfig, TheErrorModelHasToFitTheInterface) {
    NodeConfig config("sensors[0]", std::string(ieee802154_interface));
    config.radio.error_model = "Ieee80211NistErrorModel";
    EXPECT_EQ(error_text([&] { config.validate(); }),
              "radio.error_model = \"Ieee80211NistErrorModel\": expected \"Ieee802154ErrorModel\", the one "
              "for a node "
              "with an Ieee802154NarrowbandInterface");
}

TEST(NodeConfig, ChecksItsMobility) {
    NodeConfig config("uavs[0]");
    config.mobility.speed_mps = -1;
    EXPECT_EQ(error_text([&] { config.validate(); }), "mobility.speed_mps = -1 m/s: expected at least 0 m/s");
}

}  // namespace
}  // namespace netsim
