#include "netsim/config/node_config.hpp"

#include <limits>

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

TEST(NodeConfig, ChecksItsMobility) {
    NodeConfig config("uavs[0]");
    config.mobility.speed_mps = -1;
    EXPECT_EQ(error_text([&] { config.validate(); }), "mobility.speed_mps = -1 m/s: expected at least 0 m/s");
}

}  // namespace
}  // namespace netsim
