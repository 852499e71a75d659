#include "netsim/carrier_sense/energy_ring.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr double level_w = 1e-12;

// Power 1e-12 W at 100 m, falling with the square.
double reach_m(double power_w) {
    return 100 * std::sqrt(level_w / power_w);
}

auto from_distance(double between_m) {
    return [between_m](double radius_m) {
        const double distance_m = std::max(between_m - radius_m, 1.0);
        return level_w * 1e4 / (distance_m * distance_m);
    };
}

EnergyRing ring_alone() {
    EnergyRing ring;
    ring.begin(level_w, reach_m(EnergyRing::first_zone_w(level_w)), reach_m(EnergyRing::outer_w(level_w)));
    return ring;
}

// As the medium does it: zone by zone only if one number does not tell that the first is enough.
EnergyRing ring_beside(double between_m, std::size_t count = 1) {
    EnergyRing ring = ring_alone();
    for (std::size_t i = 0; i < count; ++i) {
        ring.add(from_distance(between_m));
    }
    if (ring.is_too_narrow()) {
        ring.forget_others(count, reach_m);
        for (std::size_t i = 0; i < count; ++i) {
            ring.add(from_distance(between_m));
        }
        ring.widen();
    }
    return ring;
}

bool is_first_zone(const EnergyRing& ring) {
    return ring.least_power_w() == EnergyRing::first_zone_w(level_w);
}

TEST(EnergyRing, WatchesTheFirstZoneFromTheBeginning) {
    const EnergyRing ring = ring_alone();
    EXPECT_TRUE(is_first_zone(ring));
    EXPECT_EQ(ring.radius_m(), reach_m(EnergyRing::first_zone_w(level_w)));
    EXPECT_FALSE(ring.is_too_narrow());
}

TEST(EnergyRing, IsThinIfTheOthersAreFarAway) {
    const EnergyRing ring = ring_beside(10'000);
    EXPECT_FALSE(ring.is_too_narrow());
    EXPECT_LT(ring.radius_m(), 1.12 * 100);
    EXPECT_GE(ring.radius_m(), reach_m(0.99 * level_w));
}

TEST(EnergyRing, IsNoMoreThanTheFirstZoneThen) {
    EXPECT_TRUE(is_first_zone(ring_beside(10'000)));
}

TEST(EnergyRing, TheFirstZoneIsNotEnoughIfOneOfThemIsNear) {
    EXPECT_FALSE(is_first_zone(ring_beside(300)));
}

TEST(EnergyRing, OfVeryManyFarAwayTheFirstZoneIsEnoughIfZonesAreToldApart) {
    EXPECT_TRUE(is_first_zone(ring_beside(10'000, 100)));
}

TEST(EnergyRing, WatchesNobodyBeforeThereAreOthersIfAnythingIsNoticed) {
    EnergyRing ring;
    ring.begin_without_zones();
    EXPECT_EQ(ring.radius_m(), 0);
    EXPECT_EQ(ring.least_power_w(), std::numeric_limits<double>::infinity());
    EXPECT_TRUE(ring.is_too_narrow());
}

TEST(EnergyRing, ReachesWhereTwoEqualPowersMakeTheLevel) {
    // Midway between them each brings half of it.
    EXPECT_GE(ring_beside(2 * 100 * std::sqrt(2) - 1).radius_m(), 100 * std::sqrt(2) - 1);
}

// Whatever the sum of all reaches the level is within the ring of the strongest.
TEST(EnergyRing, LeavesOutNobodyWithTheLevel) {
    for (const double between_m : {50.0, 150.0, 220.0, 250.0, 280.0, 300.0, 500.0, 600.0, 750.0, 1500.0}) {
        for (const std::size_t count : {1U, 2U, 4U, 5U, 20U, 300U}) {
            const EnergyRing ring = ring_beside(between_m, count);
            for (int step = 0; step <= 856; ++step) {
                const double x_m = std::pow(1.01, step);  // from 1 to 5000
                const double here_w = level_w * 1e4 / (x_m * x_m);
                const double away_m = std::max(std::abs(between_m - x_m), 1.0);
                const double there_w = level_w * 1e4 / (away_m * away_m);
                if (here_w >= there_w && here_w + static_cast<double>(count) * there_w >= level_w) {
                    EXPECT_GE(here_w, ring.least_power_w()) << between_m << " m, " << count << ", at " << x_m;
                }
            }
        }
    }
}

// Far out, where it is weak, very many may add up, of which none is stronger than it.
TEST(EnergyRing, BesideManyTheFirstZoneAloneTellsNothing) {
    EnergyRing ring = ring_alone();
    const auto nothing_near = [](double radius_m) { return radius_m < 300 ? 0 : level_w / 10; };
    for (int others = 1; others <= 4; ++others) {
        ring.add(nothing_near);
        EXPECT_FALSE(ring.is_too_narrow()) << others;
    }
    ring.add(nothing_near);
    EXPECT_TRUE(ring.is_too_narrow());
}

TEST(EnergyRing, BecomesTooNarrowWhenAnotherOneComesNear) {
    EnergyRing ring = ring_beside(10'000);
    ring.add(from_distance(15'000));
    EXPECT_FALSE(ring.is_too_narrow());
    ring.add(from_distance(250));
    EXPECT_TRUE(ring.is_too_narrow());
}

TEST(EnergyRing, DoesNotShrinkWhenOthersAreOver) {
    EnergyRing ring = ring_beside(250);
    const double radius_m = ring.radius_m();
    ring.forget_others(1, reach_m);
    ring.add(from_distance(20'000));
    EXPECT_FALSE(ring.is_too_narrow());
    ring.widen();
    EXPECT_EQ(ring.radius_m(), radius_m);
}

TEST(EnergyRing, WatchesEverybodyIfNoEnergyIsTooSmall) {
    EnergyRing ring;
    ring.begin_without_zones();
    ring.forget_others(1, reach_m);
    ring.add(from_distance(1000));
    ring.widen();
    EXPECT_EQ(ring.least_power_w(), 0);
    EXPECT_EQ(ring.radius_m(), std::numeric_limits<double>::infinity());
    EXPECT_FALSE(ring.is_too_narrow());
}

TEST(EnergyRing, ForgetsAllWhenItBeginsAgain) {
    EnergyRing ring = ring_beside(250);
    ring.watched().push_back({3, {}, 0});
    ring.begin(level_w, 105, 224);
    EXPECT_TRUE(ring.watched().empty());
    EXPECT_EQ(ring.radius_m(), 105);
    EXPECT_FALSE(ring.is_too_narrow());
}

TEST(EnergyRing, ForgetsAllWhenItBeginsAgainWithoutZones) {
    EnergyRing ring = ring_beside(250);
    ring.watched().push_back({3, {}, 0});
    ring.begin_without_zones();
    EXPECT_TRUE(ring.watched().empty());
    EXPECT_EQ(ring.radius_m(), 0);
    EXPECT_TRUE(ring.is_too_narrow());
}

}  // namespace
}  // namespace netsim
