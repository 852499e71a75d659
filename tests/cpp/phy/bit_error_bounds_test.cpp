#include "netsim/phy/bit_error_bounds.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

double rate_at(double snir) {
    return 0.5 * std::exp(-snir);
}

// In increasing order, from 1e-3 to 1.3e6.
std::vector<double> ratios() {
    std::vector<double> all;
    for (int step = 0; step < 30'000; ++step) {
        all.push_back(1e-3 * std::pow(1.0007, step));
    }
    return all;
}

TEST(BitErrorBounds, TheRateIsNowhereBeyondThem) {
    const BitErrorBounds bounds(rate_at);
    for (const double snir : ratios()) {
        EXPECT_GE(bounds.ceiling(snir), rate_at(snir)) << snir;
        EXPECT_LE(bounds.floor(snir), rate_at(snir)) << snir;
    }
}

TEST(BitErrorBounds, NeverRise) {
    const BitErrorBounds bounds(rate_at);
    double ceiling = 1;
    double floor = 1;
    for (const double snir : ratios()) {
        EXPECT_LE(bounds.ceiling(snir), ceiling) << snir;
        EXPECT_LE(bounds.floor(snir), floor) << snir;
        ceiling = bounds.ceiling(snir);
        floor = bounds.floor(snir);
    }
}

TEST(BitErrorBounds, AreThoseOfALittleLessAndALittleMoreSnir) {
    const BitErrorBounds bounds(rate_at);
    constexpr double step = 1 + 1.0 / 32;
    for (const double snir : {0.125, 0.99, 1.0, 3.7, 20.0, 1000.0}) {
        EXPECT_LE(bounds.ceiling(snir), rate_at(snir / step) * (1 + 1e-12)) << snir;
        EXPECT_GE(bounds.floor(snir), rate_at(snir * step) * (1 - 1e-12)) << snir;
    }
}

TEST(BitErrorBounds, OfTheWeakestOnlyTheFloorIsKnown) {
    for (const double snir : {0.0, 1e-300, 0.1249}) {
        EXPECT_EQ(BitErrorBounds(rate_at).ceiling(snir), 1) << snir;
        EXPECT_EQ(BitErrorBounds(rate_at).floor(snir), rate_at(0.125)) << snir;
    }
}

TEST(BitErrorBounds, BeyondTheStepsTheCeilingIsThatOfTheLastAndThereIsNoFloor) {
    const BitErrorBounds bounds([](double snir) { return 1 / snir; });
    for (const double snir : {2048.0, 1e9, std::numeric_limits<double>::infinity()}) {
        EXPECT_EQ(bounds.ceiling(snir), 1.0 / 2048) << snir;
        EXPECT_EQ(bounds.floor(snir), 0) << snir;
    }
    EXPECT_EQ(bounds.floor(2047), 1.0 / 2048);
}

}  // namespace
}  // namespace netsim
