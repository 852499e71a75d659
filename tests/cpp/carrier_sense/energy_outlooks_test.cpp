#include "netsim/carrier_sense/energy_outlooks.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr double noise_w = 1e-14;
constexpr double level_w = 1e-12;

SimTime us(std::int64_t microseconds) {
    return SimTime::from_us(microseconds);
}

class EnergyOutlooksTest : public testing::Test {
protected:
    EnergyOutlooksTest() {
        for (int radio = 0; radio < radios; ++radio) {
            outlooks.add_radio();
        }
    }
    EnergyOutlook& with_one_until(RadioId radio, SimTime start, SimTime end) {
        EnergyOutlook& outlook = outlooks.of(radio, noise_w, start);
        outlook.forecast.begin_at(start);
        outlook.forecast.add_untold({1, start, end, level_w / 2});
        return outlook;
    }

    static constexpr int radios = 100;
    EnergyOutlooks outlooks;
};

TEST_F(EnergyOutlooksTest, WhoWasNotAskedForHasNone) {
    outlooks.of(1, noise_w, us(0));
    EXPECT_TRUE(outlooks.has(1));
    EXPECT_FALSE(outlooks.has(0));
}

TEST_F(EnergyOutlooksTest, ANewOneKnowsNothingButTheNoise) {
    EnergyOutlook& outlook = outlooks.of(1, noise_w, us(5));
    EXPECT_EQ(outlook.next_id, 0U);
    EXPECT_EQ(outlook.rests_until, SimTime::long_ago());
    outlook.forecast.begin_at(us(5));
    EXPECT_NEAR(outlook.forecast.settle(level_w, [](const auto&) {}), level_w - noise_w, 1e-20);
}

TEST_F(EnergyOutlooksTest, IsKeptForItsRadioWhileAnythingLasts) {
    EnergyOutlook& first = with_one_until(0, us(0), us(1000));
    for (RadioId radio = 1; radio < radios; ++radio) {
        with_one_until(radio, us(radio), us(1000));
    }
    EXPECT_EQ(&outlooks.of(0, noise_w, us(999)), &first);
    EXPECT_EQ(first.radio, 0);
}

TEST_F(EnergyOutlooksTest, WhatIsOverIsUsedAgainAndForgotten) {
    for (RadioId radio = 0; radio < radios; ++radio) {
        const SimTime start = us(10) * radio;
        EnergyOutlook& outlook = with_one_until(radio, start, start + us(5));
        outlook.next_id = 7;
        outlook.rests_until = start + us(3);
    }
    EXPECT_LE(outlooks.capacity(), 2U);
    EXPECT_FALSE(outlooks.has(0));
    EnergyOutlook& again = outlooks.of(0, noise_w, us(2000));
    EXPECT_EQ(again.next_id, 0U);
    EXPECT_EQ(again.rests_until, SimTime::long_ago());
}

}  // namespace
}  // namespace netsim
