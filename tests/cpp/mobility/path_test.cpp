#include "netsim/mobility/path.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

MobilityConfig config_of(const char* type_name, double speed_mps) {
    MobilityConfig config;
    config.type_name = type_name;
    config.speed_mps = speed_mps;
    config.area_min = {0, 0, 0};
    config.area_max = {100, 50, 0};
    config.radius_m = 100;
    return config;
}

void expect_at(const Path& path, double time_s, Position expected) {
    EXPECT_LT(distance(path.at(time_s), expected), 1e-9) << time_s;
}

TEST(LinearPath, IsReflectedAtTheWalls) {
    MobilityConfig config = config_of("LinearMobility", 10);
    config.movement_heading_rad = std::atan2(3, 4);
    const auto path = make_path(config, {80, 10, 0});
    EXPECT_DOUBLE_EQ(path->next_turn_s(0), 2.5);  // at x = 100
    expect_at(*path, 2.5, {100, 25, 0});
    expect_at(*path, 5, {80, 40, 0});
    EXPECT_DOUBLE_EQ(path->next_turn_s(2.6), 40.0 / 6);  // at y = 50
    expect_at(*path, 10, {40, 30, 0});
}

TEST(LinearPath, WithoutRoomNothingMovesOnAnAxis) {
    MobilityConfig config = config_of("LinearMobility", 10);
    config.movement_elevation_rad = std::numbers::pi / 2;
    const auto path = make_path(config, {80, 10, 0});
    EXPECT_NEAR(path->at(7).z, 0, 1e-9);
}

TEST(CirclePath, HasItsCornersOnTheCircleAndItsSidesAtMostOneCentimeterInside) {
    const auto path = make_path(config_of("CircleMobility", 10), {});
    const double side_s = path->next_turn_s(0);
    const Position middle = (path->at(0) + path->at(side_s)) * 0.5;
    EXPECT_GT(distance(middle, {}), 100 - 0.01);
    EXPECT_LT(distance(middle, {}), 100 - 0.009);
    expect_at(*path, 0, {100, 0, 0});
    expect_at(*path, 2 * std::numbers::pi * 10, {100, 0, 0});
    EXPECT_DOUBLE_EQ(path->next_turn_s(1.5 * side_s), 2 * side_s);
}

TEST(RectanglePath, RunsFromCornerToCorner) {
    MobilityConfig config = config_of("RectangleMobility", 10);
    config.start_pos = 0.5;
    const auto path = make_path(config, {1, 2, 7});
    expect_at(*path, 0, {50, 0, 7});
    EXPECT_DOUBLE_EQ(path->next_turn_s(0), 5);
    expect_at(*path, 5, {100, 0, 7});
    expect_at(*path, 7.5, {100, 25, 7});
    expect_at(*path, 15, {50, 50, 7});
    expect_at(*path, 22.5, {0, 25, 7});
    EXPECT_DOUBLE_EQ(path->next_turn_s(24), 25);
    EXPECT_DOUBLE_EQ(path->next_turn_s(26), 35);
    expect_at(*path, 30, {50, 0, 7});
}

TEST(Paths, AtSpeedZeroHaveNoTurns) {
    for (const char* name : {"LinearMobility", "CircleMobility", "RectangleMobility"}) {
        const auto path = make_path(config_of(name, 0), {});
        EXPECT_EQ(path->next_turn_s(5), infinity) << name;
        EXPECT_EQ(path->at(5), path->at(0)) << name;
    }
}

}  // namespace
}  // namespace netsim
