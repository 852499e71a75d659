#include "netsim/propagation/gain_tail_bound.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace netsim {
namespace {

double rayleigh(double from_0) {
    return from_0 * from_0 / 2;
}

// As for Rayleigh's gains: a gain above g has the probability exp(−g).
TEST(GainTailBound, MatchesTheDistanceFromZero) {
    const GainTailBound rare(rayleigh, 6);
    for (const double gain : {0.125, 1.0, 1.25, 1.5, 4.0, 16.0}) {  // starts of steps
        EXPECT_NEAR(rare.chance_beyond(gain), std::exp(-gain), 1e-8 * std::exp(-gain)) << gain;
    }
}

TEST(GainTailBound, IsTooLargeByAQuarterAtMost) {
    const GainTailBound rare(rayleigh, 6);
    for (int percent = 2; percent < 1800; ++percent) {
        const double gain = percent / 100.0;
        EXPECT_GE(rare.chance_beyond(gain), std::exp(-gain)) << gain;
        EXPECT_LE(rare.chance_beyond(gain), std::exp(-gain / 1.25) * (1 + 1e-8)) << gain;
    }
}

TEST(GainTailBound, IsOneForGainsOfEveryPair) {
    const GainTailBound rare([](double from_0) { return std::exp(from_0); }, 6);
    EXPECT_EQ(rare.chance_beyond(0), 1);
    EXPECT_EQ(rare.chance_beyond(0.99), 1);
    EXPECT_GE(rare.chance_beyond(1), 1);
    EXPECT_LT(rare.chance_beyond(2), 1);
}

TEST(GainTailBound, IsThatOfTheLargestForGainsOfNoPair) {
    const GainTailBound rare(rayleigh, 6);
    EXPECT_EQ(rare.chance_beyond(1e6), rare.chance_beyond(18));
    EXPECT_EQ(rare.chance_beyond(INFINITY), rare.chance_beyond(18));
}

TEST(GainTailBound, IsOneWithoutSpread) {
    const GainTailBound constant([](double) { return 1.0; }, 6);
    EXPECT_GE(constant.chance_beyond(0.5), 1);
    EXPECT_GE(constant.chance_beyond(1), 1);
}

TEST(GainTailBound, IsOneForNan) {
    EXPECT_EQ(GainTailBound(rayleigh, 6).chance_beyond(NAN), 1);
    EXPECT_EQ(GainTailBound().chance_beyond(5), 1);
}

}  // namespace
}  // namespace netsim
