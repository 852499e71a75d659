#include "netsim/mobility/quadcopter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr Position start{0, 0, 20};
constexpr Airframe usual{.acceleration_mps2 = 2.5, .drag_kgps = 0.3};

Quadcopter vehicle(double speed_mps = 10, const WindConfig& wind = {}, Position from = start) {
    return {from, speed_mps, usual, Wind(wind, 1, 0)};
}

// Its positions after each step.
std::vector<Position> flown(Quadcopter& vehicle, double seconds, GaussMarkov* error = nullptr) {
    std::vector<Position> positions;
    const auto steps = static_cast<int>(std::lround(seconds / Quadcopter::step_s));
    for (int step = 0; step < steps; ++step) {
        vehicle.step(error);
        positions.push_back(vehicle.position());
    }
    return positions;
}

double fastest_mps(const std::vector<Position>& positions) {
    double fastest = 0;
    for (std::size_t number = 1; number < positions.size(); ++number) {
        fastest = std::max(fastest, distance(positions[number - 1], positions[number]) / Quadcopter::step_s);
    }
    return fastest;
}

TEST(Quadcopter, HoversWithoutATarget) {
    Quadcopter hovering = vehicle();
    for (const Position& position : flown(hovering, 10)) {
        EXPECT_LT(distance(position, start), 1e-9);
    }
}

TEST(Quadcopter, SpeedsUpFliesAndStopsAtItsTarget) {
    Quadcopter flying = vehicle();
    flying.go_to({100, 0, 20});
    const auto positions = flown(flying, 20);
    EXPECT_GT(positions[99].x, 0.5);  // 1 s: half of 2.5 m/s² times its square, less the time to tilt
    EXPECT_LT(positions[99].x, 1.25);
    EXPECT_NEAR(fastest_mps(positions), 10, 0.1);
    const auto farthest = std::ranges::max_element(positions, {}, &Position::x);
    EXPECT_LT(farthest->x, 100.1);
    EXPECT_LT(distance(positions.back(), {100, 0, 20}), 0.05);
}

TEST(Quadcopter, StaysWithinItsLimits) {
    Quadcopter flying = vehicle(20, {.speed_mps = 12, .heading_rad = std::numbers::pi});
    flying.go_to({200, 100, 80});
    double steepest = 0;
    for (int number = 0; number < 3000; ++number) {
        const Position before = flying.position();
        flying.step(nullptr);
        steepest = std::max(steepest, flying.tilt_rad());
        EXPECT_LT((flying.position().z - before.z) / Quadcopter::step_s, 2.6);
    }
    EXPECT_LT(steepest, 33 * degree);
    EXPECT_GT(steepest, 25 * degree);
}

TEST(Quadcopter, BrakesWhereItIsStopped) {
    Quadcopter flying = vehicle();
    flying.go_to({1000, 0, 20});
    flown(flying, 20);
    const double brakes_at_m = flying.position().x;
    flying.set_speed(0);
    const double stopped_m = flown(flying, 10).back().x;
    EXPECT_NEAR(stopped_m - brakes_at_m, 23, 3);  // v²/2a is 20 m
}

TEST(Quadcopter, SpeedsUpAndBrakesWithItsAcceleration) {
    Quadcopter flying(start, 10, {.acceleration_mps2 = 0.9, .drag_kgps = 0.3}, Wind({}, 1, 0));
    flying.go_to({200, 0, 20});
    const auto positions = flown(flying, 40);
    EXPECT_GT(positions[499].x, 9);  // 5 s: half of 0.9 m/s² times its square, less the time to tilt
    EXPECT_LT(positions[499].x, 11.25);
    EXPECT_LT(std::ranges::max_element(positions, {}, &Position::x)->x, 200.1);
    EXPECT_LT(distance(positions.back(), {200, 0, 20}), 0.05);
}

// At a constant speed, drag is the horizontal part of the thrust: tan α = drag · v / (m g).
TEST(Quadcopter, TiltsAgainstItsDrag) {
    for (const double drag_kgps : {0.3, 0.8}) {
        Quadcopter hovering(start, 10, {.acceleration_mps2 = 2.5, .drag_kgps = drag_kgps},
                            Wind({.speed_mps = 8}, 1, 0));
        flown(hovering, 30);
        EXPECT_NEAR(std::tan(hovering.tilt_rad()), drag_kgps * 8 / (2 * 9.80665), 1e-3);
    }
}

TEST(Quadcopter, HoldsItsPlaceInWind) {
    Quadcopter hovering = vehicle(10, {.speed_mps = 8, .gusts_mps = 1.5});
    flown(hovering, 10);
    for (const Position& position : flown(hovering, 60)) {
        EXPECT_LT(distance(position, start), 0.2);
    }
}

TEST(Quadcopter, LandsAndTakesOffAgain) {
    Quadcopter flying = vehicle();
    flying.go_to({0, 0, 0});
    const auto down = flown(flying, 25);
    EXPECT_EQ(down.back().z, 0);
    EXPECT_LT(fastest_mps(down), 1.6);
    flying.go_to({30, 0, 0});
    const auto across = flown(flying, 25);
    EXPECT_LT(distance(across.back(), {30, 0, 0}), 0.1);
    EXPECT_NEAR(std::ranges::max_element(across, {}, &Position::z)->z, 0.5, 0.1);
}

TEST(Quadcopter, FliesByThePositionThatItKnows) {
    GaussMarkov error(RandomStream(1, 0, Purpose::position_error), {2, 2, 3}, 30, 1);
    GaussMarkov same = error;
    Quadcopter hovering = vehicle();
    flown(hovering, 60, &error);
    EXPECT_LT(distance(hovering.position() + same.at(60), start), 0.7);
    EXPECT_GT(distance(hovering.position(), start), 0.7);
}

}  // namespace
}  // namespace netsim
