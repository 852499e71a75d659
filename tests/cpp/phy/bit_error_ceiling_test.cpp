#include "netsim/phy/bit_error_ceiling.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace netsim {
namespace {

double rate_at(double snir) {
    return 0.5 * std::exp(-snir);
}

TEST(BitErrorCeiling, IsNowhereBelowTheRate) {
    const BitErrorCeiling ceiling(rate_at);
    for (int step = 0; step < 30'000; ++step) {
        const double snir = 1e-3 * std::pow(1.0007, step);  // up to 1.3e6
        EXPECT_GE(ceiling.at(snir), rate_at(snir)) << snir;
    }
}

TEST(BitErrorCeiling, NeverRises) {
    const BitErrorCeiling ceiling(rate_at);
    double before = 1;
    for (int step = 0; step < 30'000; ++step) {
        const double snir = 1e-3 * std::pow(1.0007, step);
        EXPECT_LE(ceiling.at(snir), before) << snir;
        before = ceiling.at(snir);
    }
}

TEST(BitErrorCeiling, IsThatOfALittleLessSnir) {
    const BitErrorCeiling ceiling(rate_at);
    for (const double snir : {0.125, 0.99, 1.0, 3.7, 20.0, 2047.0}) {
        EXPECT_LE(ceiling.at(snir), rate_at(snir / (1 + 1.0 / 32)) * (1 + 1e-12)) << snir;
    }
}

TEST(BitErrorCeiling, KnowsNothingOfTheWeakest) {
    EXPECT_EQ(BitErrorCeiling(rate_at).at(0), 1);
    EXPECT_EQ(BitErrorCeiling(rate_at).at(0.1249), 1);
}

TEST(BitErrorCeiling, BeyondItsStepsIsThatOfTheLast) {
    const BitErrorCeiling ceiling([](double snir) { return 1 / snir; });
    EXPECT_EQ(ceiling.at(1e9), ceiling.at(2048));
    EXPECT_EQ(ceiling.at(std::numeric_limits<double>::infinity()), ceiling.at(2048));
}

}  // namespace
}  // namespace netsim
