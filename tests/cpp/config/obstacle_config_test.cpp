#include "netsim/config/obstacle_config.hpp"

#include <string>

#include <gtest/gtest.h>

#include "config/error_text.hpp"

namespace netsim {
namespace {

ObstacleConfig house() {
    ObstacleConfig config;
    config.rings = {{{0, 0}, {10, 0}, {10, 10}, {0, 10}}};
    config.top_m = 5;
    return config;
}

template <typename Value>
std::string text_with(Value ObstacleConfig::* field, const Value& value) {
    ObstacleConfig config = house();
    config.*field = value;
    return error_text([&] { config.validate(); });
}

TEST(ObstacleConfig, ValidateNamesTheField) {
    EXPECT_EQ(error_text([] { house().validate(); }), "no error");
    EXPECT_EQ(text_with(&ObstacleConfig::rings, {}),
              "obstacle.rings = []: expected the footprint, at least one ring of corners");
    EXPECT_EQ(text_with(&ObstacleConfig::rings, {{{0, 0}, {1, 1}}}),
              "obstacle.rings: a ring of 2 corners: expected at least 3");
    EXPECT_EQ(text_with(&ObstacleConfig::rings, {{{0, 0}, {1, 1}, {0, 2e7}}}),
              "obstacle.rings = 20000000 m: expected from -10000000 m to 10000000 m");
    EXPECT_EQ(text_with(&ObstacleConfig::top_m, 0.0), "obstacle.top_m = 0 m: expected more than 0 m");
    EXPECT_NE(text_with<std::string>(&ObstacleConfig::material, "bricks").find("did you mean brick?"),
              std::string::npos);
}

}  // namespace
}  // namespace netsim
