#include "netsim/carrier_sense/watch_zones.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr double level_w = 1e-12;

// Power 1e-12 W at 100 m, decreasing with the square.
double reach_m(double power_w) {
    return 100 * std::sqrt(level_w / power_w);
}

auto from_distance(double between_m) {
    return [between_m](double radius_m) {
        const double distance_m = std::max(between_m - radius_m, 1.0);
        return level_w * 1e4 / (distance_m * distance_m);
    };
}

WatchZones ring_alone() {
    WatchZones zones;
    zones.begin(level_w, reach_m(WatchZones::first_zone_w(level_w)),
                reach_m(WatchZones::outer_zone_w(level_w)));
    return zones;
}

// As in the medium: zone by zone only if the first zone may not suffice.
WatchZones ring_beside(double between_m, std::size_t count = 1) {
    WatchZones zones = ring_alone();
    for (std::size_t i = 0; i < count; ++i) {
        zones.add(from_distance(between_m));
    }
    if (zones.is_too_narrow()) {
        zones.reset_others(count, reach_m);
        for (std::size_t i = 0; i < count; ++i) {
            zones.add(from_distance(between_m));
        }
        zones.widen();
    }
    return zones;
}

bool is_first_zone(const WatchZones& zones) {
    return zones.min_power_w() == WatchZones::first_zone_w(level_w);
}

TEST(WatchZones, WatchesTheFirstZoneFromTheStart) {
    const WatchZones zones = ring_alone();
    EXPECT_TRUE(is_first_zone(zones));
    EXPECT_EQ(zones.radius_m(), reach_m(WatchZones::first_zone_w(level_w)));
    EXPECT_FALSE(zones.is_too_narrow());
}

TEST(WatchZones, FirstZoneSufficesIfTheOthersAreFarAway) {
    const WatchZones zones = ring_beside(10'000);
    EXPECT_FALSE(zones.is_too_narrow());
    EXPECT_LT(zones.radius_m(), 1.12 * 100);
    EXPECT_GE(zones.radius_m(), reach_m(0.99 * level_w));
}

TEST(WatchZones, IsOnlyTheFirstZoneThen) {
    EXPECT_TRUE(is_first_zone(ring_beside(10'000)));
}

TEST(WatchZones, FirstZoneDoesNotSufficeIfAnotherIsNear) {
    EXPECT_FALSE(is_first_zone(ring_beside(300)));
}

TEST(WatchZones, FirstZoneSufficesForVeryManyFarAwayWithSeparateZones) {
    EXPECT_TRUE(is_first_zone(ring_beside(10'000, 100)));
}

TEST(WatchZones, WatchesNoReceiverBeforeThereAreOthersWithoutZones) {
    WatchZones zones;
    zones.begin_without_zones();
    EXPECT_EQ(zones.radius_m(), 0);
    EXPECT_EQ(zones.min_power_w(), std::numeric_limits<double>::infinity());
    EXPECT_TRUE(zones.is_too_narrow());
}

TEST(WatchZones, ReachesToHalfTheLevelForTwoEqualPowers) {
    // Halfway between them, each contributes half of the level.
    EXPECT_GE(ring_beside(2 * 100 * std::sqrt(2) - 1).radius_m(), 100 * std::sqrt(2) - 1);
}

// Each place at which the sum reaches the level is in the watch zones of the strongest.
TEST(WatchZones, IncludesAllReceiversWithTheLevel) {
    for (const double between_m : {50.0, 150.0, 220.0, 250.0, 280.0, 300.0, 500.0, 600.0, 750.0, 1500.0}) {
        for (const std::size_t count : {1U, 2U, 4U, 5U, 20U, 300U}) {
            const WatchZones zones = ring_beside(between_m, count);
            for (int step = 0; step <= 856; ++step) {
                const double x_m = std::pow(1.01, step);  // from 1 to 5000
                const double here_w = level_w * 1e4 / (x_m * x_m);
                const double away_m = std::max(std::abs(between_m - x_m), 1.0);
                const double there_w = level_w * 1e4 / (away_m * away_m);
                if (here_w >= there_w && here_w + static_cast<double>(count) * there_w >= level_w) {
                    EXPECT_GE(here_w, zones.min_power_w()) << between_m << " m, " << count << ", at " << x_m;
                }
            }
        }
    }
}

// Far away, where it is weak, many weaker signals may add up.
TEST(WatchZones, FirstZoneDoesNotSufficeForMany) {
    WatchZones zones = ring_alone();
    const auto nothing_near = [](double radius_m) { return radius_m < 300 ? 0 : level_w / 10; };
    for (int others = 1; others <= 4; ++others) {
        zones.add(nothing_near);
        EXPECT_FALSE(zones.is_too_narrow()) << others;
    }
    zones.add(nothing_near);
    EXPECT_TRUE(zones.is_too_narrow());
}

TEST(WatchZones, BecomesTooNarrowWhenAnotherIsNear) {
    WatchZones zones = ring_beside(10'000);
    zones.add(from_distance(15'000));
    EXPECT_FALSE(zones.is_too_narrow());
    zones.add(from_distance(250));
    EXPECT_TRUE(zones.is_too_narrow());
}

TEST(WatchZones, DoesNotShrinkWhenOthersEnd) {
    WatchZones zones = ring_beside(250);
    const double radius_m = zones.radius_m();
    zones.reset_others(1, reach_m);
    zones.add(from_distance(20'000));
    EXPECT_FALSE(zones.is_too_narrow());
    zones.widen();
    EXPECT_EQ(zones.radius_m(), radius_m);
}

TEST(WatchZones, WatchesAllIfAnyEnergyIsNoticed) {
    WatchZones zones;
    zones.begin_without_zones();
    zones.reset_others(1, reach_m);
    zones.add(from_distance(1000));
    zones.widen();
    EXPECT_EQ(zones.min_power_w(), 0);
    EXPECT_EQ(zones.radius_m(), std::numeric_limits<double>::infinity());
    EXPECT_FALSE(zones.is_too_narrow());
}

TEST(WatchZones, IsResetByBegin) {
    WatchZones zones = ring_beside(250);
    zones.watched().push_back({3, {}, 0});
    zones.begin(level_w, 105, 224);
    EXPECT_TRUE(zones.watched().empty());
    EXPECT_EQ(zones.radius_m(), 105);
    EXPECT_FALSE(zones.is_too_narrow());
}

TEST(WatchZones, IsResetByBeginWithoutZones) {
    WatchZones zones = ring_beside(250);
    zones.watched().push_back({3, {}, 0});
    zones.begin_without_zones();
    EXPECT_TRUE(zones.watched().empty());
    EXPECT_EQ(zones.radius_m(), 0);
    EXPECT_TRUE(zones.is_too_narrow());
}

}  // namespace
}  // namespace netsim
