#include "netsim/mobility/wind.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace netsim {
namespace {

TEST(Wind, ItsHeadingIsWhereTheAirMoves) {
    Wind wind({.speed_mps = 5, .heading_rad = std::numbers::pi / 2}, 1, 0);
    const Position velocity = wind.velocity_mps(3);
    EXPECT_NEAR(velocity.x, 0, 1e-12);
    EXPECT_NEAR(velocity.y, 5, 1e-12);
}

TEST(Wind, EachVehicleHasItsOwnGusts) {
    const WindConfig gusty{.gusts_mps = 2};
    Wind first(gusty, 1, 0);
    Wind second(gusty, 1, 1);
    EXPECT_NE(first.velocity_mps(1), second.velocity_mps(1));
}

TEST(Wind, GustsDeviateFromTheConstantWind) {
    Wind wind({.speed_mps = 5, .gusts_mps = 2, .gust_time_s = 1}, 1, 0);
    double sum = 0;
    double squares = 0;
    constexpr int count = 20'000;
    for (int number = 0; number < count; ++number) {
        const double off = wind.velocity_mps(number * 0.5).x - 5;
        sum += off;
        squares += off * off;
    }
    EXPECT_NEAR(sum / count, 0, 0.1);
    EXPECT_NEAR(std::sqrt(squares / count), 2, 0.1);
}

}  // namespace
}  // namespace netsim
