#include "netsim/propagation/link_gaussians.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr SimTime coherence_time = SimTime::from_us(5000);

TEST(LinkGaussians, AreTheSameFromBothEnds) {
    const LinkGaussians gaussians(7, Purpose::fading, coherence_time);
    const SimTime time = SimTime::from_us(12'345);
    EXPECT_EQ(gaussians.at(3, 8, time, 0).first, gaussians.at(8, 3, time, 1).first);
    EXPECT_EQ(gaussians.at(3, 8, time, 0).second, gaussians.at(8, 3, time, 1).second);
}

TEST(LinkGaussians, DifferWithSeedLinkAndInterval) {
    const LinkGaussians gaussians(7, Purpose::fading, coherence_time);
    const SimTime time = SimTime::from_us(12'345);
    const double here = gaussians.at(3, 8, time, 0).first;
    EXPECT_NE(here, LinkGaussians(8, Purpose::fading, coherence_time).at(3, 8, time, 0).first);
    EXPECT_NE(here, LinkGaussians(7, Purpose::shadowing, coherence_time).at(3, 8, time, 0).first);
    EXPECT_NE(
        here,
        LinkGaussians(7 + (std::uint64_t{1} << 32), Purpose::fading, coherence_time).at(3, 8, time, 0).first);
    EXPECT_NE(here, gaussians.at(3, 9, time, 0).first);
    EXPECT_NE(here, gaussians.at(2, 8, time, 0).first);
    EXPECT_NE(here, gaussians.at(3, 8, time + coherence_time, 0).first);
    EXPECT_NE(here, gaussians.at(3, 8, time, 0).second);
}

TEST(LinkGaussians, AreContinuousInTime) {
    const LinkGaussians gaussians(7, Purpose::fading, coherence_time);
    double before = gaussians.at(0, 1, SimTime(), 0).first;
    for (int us = 1; us < 20'000; ++us) {
        const double now = gaussians.at(0, 1, SimTime::from_us(us), 0).first;
        // The slope is at most π / 2 a coherence time, times a number below 6.
        ASSERT_NEAR(now, before, 6 * 1.6 / 5000 * 1.5) << us;
        before = now;
    }
}

TEST(LinkGaussians, HalfWayTheyAreTheMeanOfBothEndsAtUnchangedVariance) {
    const LinkGaussians gaussians(7, Purpose::fading, coherence_time);
    const double before = gaussians.at(0, 1, SimTime(), 0).second;
    const double after = gaussians.at(0, 1, coherence_time, 0).second;
    EXPECT_NEAR(gaussians.at(0, 1, SimTime::from_us(2500), 0).second, (before + after) / std::numbers::sqrt2,
                1e-12);
}

TEST(LinkGaussians, WhatIsNotWorkedOutLiesWithinTheGivenDistance) {
    for (const SimTime coherence : {SimTime(), coherence_time}) {
        const LinkGaussians gaussians(7, Purpose::fading, coherence);
        for (const double distance : {0.5, 1.0, 2.0, 3.0}) {
            const double chance = std::exp(-distance * distance / 2);
            int nothing = 0;
            for (std::uint32_t other = 1; other <= 2000; ++other) {
                const SimTime time = SimTime::from_us(1234);
                const GaussianPair pair = gaussians.at(0, other, time, 0);
                const auto found = gaussians.at_if_beyond(chance, 0, other, time, 0);
                if (found) {
                    ASSERT_EQ(found->first, pair.first);
                    ASSERT_EQ(found->second, pair.second);
                } else {
                    ++nothing;
                    ASSERT_LE(std::hypot(pair.first, pair.second), distance);
                }
            }
            // Two pairs: one minus the probability that the sum of their squares is larger.
            const double expected =
                coherence == SimTime() ? 1 - chance : 1 - chance * (1 + distance * distance / 2);
            EXPECT_NEAR(nothing / 2000.0, expected, 0.045) << distance;  // four standard errors
        }
    }
}

TEST(LinkGaussians, WithoutACoherenceTimeEachTransmissionHasItsOwn) {
    const LinkGaussians fresh(7, Purpose::fading, SimTime());
    const double first = fresh.at(0, 1, SimTime::from_us(5), 10).first;
    EXPECT_EQ(first, fresh.at(1, 0, SimTime::from_us(6), 10).first);
    EXPECT_NE(first, fresh.at(0, 1, SimTime::from_us(5), 11).first);
    EXPECT_NE(first, fresh.at(0, 1, SimTime::from_us(5), 10 + (std::uint64_t{1} << 32)).first);
}

TEST(LinkGaussians, HaveMeanZeroVarianceOneAndNoCorrelationAtAnyTime) {
    const LinkGaussians gaussians(7, Purpose::fading, coherence_time);
    constexpr int links = 40'000;
    for (const int us : {0, 1000, 2500, 4999}) {
        double sum = 0;
        double squares = 0;
        double products = 0;
        for (std::uint32_t node = 1; node <= links; ++node) {
            const GaussianPair pair = gaussians.at(0, node, SimTime::from_us(us), 0);
            sum += pair.first;
            squares += pair.first * pair.first;
            products += pair.first * pair.second;
        }
        // Five standard errors.
        EXPECT_NEAR(sum / links, 0, 5 / std::sqrt(links)) << us;
        EXPECT_NEAR(squares / links, 1, 5 * std::sqrt(2.0 / links)) << us;
        EXPECT_NEAR(products / links, 0, 5 / std::sqrt(links)) << us;
    }
}

}  // namespace
}  // namespace netsim
