#include "netsim/carrier_sense/energy_forecast.hpp"

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"

namespace netsim {
namespace {

constexpr double level_w = 1e-12;
constexpr double noise_w = 1e-14;
constexpr double tiny_w = 1e-20;  // beside the level

SimTime us(std::int64_t microseconds) {
    return SimTime::from_us(microseconds);
}

// What was told, by the ids of the transmissions.
struct Told {
    EnergyForecast& forecast;
    std::vector<std::uint64_t> ids;

    double settle() {
        return forecast.settle(
            level_w, [this](const EnergyForecast::Coming& coming) { ids.push_back(coming.transmission); });
    }
};

class EnergyForecastTest : public testing::Test {
protected:
    EnergyForecastTest() {
        forecast.begin(noise_w);
        forecast.begin_at(us(0));
    }

    EnergyForecast forecast;
    Told told{forecast, {}};
};

TEST_F(EnergyForecastTest, MissesWhatTheLevelIsAboveTheNoise) {
    EXPECT_NEAR(told.settle(), level_w - noise_w, tiny_w);
}

TEST_F(EnergyForecastTest, MissesLessWithWhatIsThere) {
    forecast.add_untold({1, us(1), us(10), 0.3 * level_w});
    forecast.add_told({2, us(5), us(15), 0.2 * level_w}, us(5), false);
    EXPECT_NEAR(told.settle(), 0.5 * level_w - noise_w, tiny_w);
    EXPECT_TRUE(told.ids.empty());
}

TEST_F(EnergyForecastTest, TellsOfTheStrongestAndOfNoMoreThanItTakes) {
    forecast.add_untold({1, us(1), us(10), 0.3 * level_w});
    forecast.add_untold({2, us(2), us(11), 0.5 * level_w});
    forecast.add_untold({3, us(3), us(12), 0.8 * level_w});
    told.settle();
    EXPECT_EQ(told.ids, (std::vector<std::uint64_t>{3, 2}));
}

TEST_F(EnergyForecastTest, TellsOfEachOnce) {
    forecast.add_untold({1, us(1), us(10), 0.6 * level_w});
    forecast.add_untold({2, us(2), us(10), 0.6 * level_w});
    told.settle();
    told.ids.clear();
    told.settle();
    EXPECT_TRUE(told.ids.empty());
}

TEST_F(EnergyForecastTest, WhereEnoughIsToldNothingIsMissing) {
    forecast.add_untold({1, us(1), us(10), 0.6 * level_w});
    forecast.add_untold({2, us(2), us(11), 0.7 * level_w});
    // Before and after both there is one of them.
    EXPECT_NEAR(told.settle(), 0.3 * level_w - noise_w, tiny_w);
    EXPECT_EQ(told.ids.size(), 2U);
}

TEST_F(EnergyForecastTest, TellsOfOthersForWhenOneThatWasToldEnds) {
    forecast.add_told({1, us(0), us(5), 2 * level_w}, us(0), true);
    forecast.add_untold({2, us(1), us(10), 0.6 * level_w});
    forecast.add_untold({3, us(2), us(11), 0.7 * level_w});
    told.settle();
    EXPECT_EQ(told.ids, (std::vector<std::uint64_t>{3, 2}));
}

TEST_F(EnergyForecastTest, TellsOfThoseThatLastAndNotOfThoseThatEndBeforeThem) {
    for (std::int64_t id = 1; id <= 6; ++id) {
        const double power_w = static_cast<double>(11 - id) / 10 * 0.95 * level_w;
        forecast.add_untold({static_cast<std::uint64_t>(id), us(-1), us(10 + id), power_w});
    }
    told.settle();
    EXPECT_EQ(told.ids, (std::vector<std::uint64_t>{5, 6}));
}

TEST_F(EnergyForecastTest, OnesAfterEachOtherDoNotAddUp) {
    forecast.add_untold({1, us(1), us(10), 0.6 * level_w});
    forecast.add_untold({2, us(11), us(20), 0.7 * level_w});
    EXPECT_NEAR(told.settle(), 0.3 * level_w - noise_w, tiny_w);
    EXPECT_TRUE(told.ids.empty());
}

TEST_F(EnergyForecastTest, InOneMomentAllThatBeginsAndEndsIsThere) {
    forecast.add_untold({1, us(1), us(10), 0.6 * level_w});
    forecast.add_untold({2, us(10), us(20), 0.6 * level_w});
    told.settle();
    EXPECT_EQ(told.ids.size(), 2U);
}

TEST_F(EnergyForecastTest, InOneMomentWhatWasToldAndBeginsIsNotThere) {
    forecast.add_told({1, us(5), us(15), 2 * level_w}, us(5), true);
    forecast.add_told({2, us(5), us(15), 2 * level_w}, us(5), true);
    forecast.add_untold({3, us(1), us(20), 0.1 * level_w});
    told.settle();
    EXPECT_EQ(told.ids, (std::vector<std::uint64_t>{3}));
}

TEST_F(EnergyForecastTest, WhatIsOverDoesNotCount) {
    forecast.add_untold({1, us(1), us(10), 0.6 * level_w});
    forecast.add_untold({2, us(1), us(20), 0.1 * level_w});
    told.settle();
    forecast.begin_at(us(11));
    EXPECT_NEAR(told.settle(), 0.9 * level_w - noise_w, tiny_w);
    forecast.add_untold({3, us(11), us(30), 0.7 * level_w});
    EXPECT_NEAR(told.settle(), 0.2 * level_w - noise_w, tiny_w);
}

TEST_F(EnergyForecastTest, WhatBeganBeforeCounts) {
    forecast.begin_at(us(10));
    forecast.add_untold({1, us(1), us(20), 0.6 * level_w});
    EXPECT_NEAR(told.settle(), 0.4 * level_w - noise_w, tiny_w);
}

TEST_F(EnergyForecastTest, WhatMayBeLeftOutIsNotEnough) {
    forecast.add_told({1, us(1), us(20), 0.95 * level_w}, us(5), false);
    forecast.add_untold({2, us(1), us(4), 0.02 * level_w});
    forecast.add_untold({3, us(1), us(4), 0.03 * level_w});
    told.settle();
    EXPECT_EQ(told.ids, (std::vector<std::uint64_t>{3, 2}));
}

TEST_F(EnergyForecastTest, WhatIsSensedIsEnough) {
    forecast.add_told({1, us(1), us(20), 0.98 * level_w}, us(5), false);
    forecast.add_untold({2, us(6), us(21), 0.02 * level_w});
    forecast.add_untold({3, us(7), us(22), 0.01 * level_w});
    told.settle();
    EXPECT_EQ(told.ids, (std::vector<std::uint64_t>{2}));
}

TEST_F(EnergyForecastTest, OnesBesideALoudOneMatterWhileItMayBeLeftOut) {
    forecast.add_told({1, us(1), us(20), 2 * level_w}, us(5), true);
    forecast.add_untold({2, us(2), us(4), 0.3 * level_w});
    EXPECT_NEAR(told.settle(), 0.7 * level_w - noise_w, tiny_w);
    EXPECT_TRUE(told.ids.empty());
    forecast.add_untold({3, us(3), us(19), 0.8 * level_w});
    told.settle();
    EXPECT_EQ(told.ids, (std::vector<std::uint64_t>{3, 2}));
}

TEST_F(EnergyForecastTest, ALoudOneThatEndsBeforeItIsSensedIsOfNoInterest) {
    forecast.add_told({1, us(1), us(4), 2 * level_w}, us(5), true);
    EXPECT_NEAR(told.settle(), level_w - noise_w, tiny_w);
}

TEST_F(EnergyForecastTest, IsToldUntilWhatWasToldIsNotEnough) {
    forecast.add_told({1, us(-1), us(10), 2 * level_w}, us(-1), true);
    forecast.add_told({2, us(5), us(20), 0.6 * level_w}, us(5), false);
    forecast.add_told({3, us(5), us(15), 0.6 * level_w}, us(5), false);
    EXPECT_EQ(forecast.told_until(level_w), us(15));
}

TEST_F(EnergyForecastTest, IsToldUntilNowWhileWhatWasToldIsNotEnough) {
    forecast.add_told({1, us(1), us(10), 2 * level_w}, us(1), true);
    EXPECT_EQ(forecast.told_until(level_w), us(0));
}

// Perhaps it has not begun yet: what is due in the same instant has turns.
TEST_F(EnergyForecastTest, IsToldUntilNowIfWhatWasToldBeginsNow) {
    forecast.add_told({1, us(0), us(10), 2 * level_w}, us(0), true);
    EXPECT_EQ(forecast.told_until(level_w), us(0));
}

TEST_F(EnergyForecastTest, IsToldUntilTheMomentInWhichOneEndsAndTheNextBegins) {
    forecast.add_told({1, us(-1), us(10), 2 * level_w}, us(-1), true);
    forecast.add_told({2, us(10), us(20), 2 * level_w}, us(10), true);
    EXPECT_EQ(forecast.told_until(level_w), us(10));
}

TEST_F(EnergyForecastTest, IsToldAsFarAsIsKnownWhereTheNoiseIsEnough) {
    EnergyForecast loud;
    loud.begin(2 * level_w);
    loud.begin_at(us(0));
    loud.add_untold({1, us(1), us(10), level_w});
    EXPECT_EQ(loud.told_until(level_w), us(10));
    loud.begin_at(us(30));
    EXPECT_EQ(loud.told_until(level_w), us(30));
}

TEST_F(EnergyForecastTest, LevelsAreNotLostBesideLargePowers) {
    for (SimTime start; start < us(10'000); start += us(10)) {
        forecast.begin_at(start);
        forecast.add_told({1, start, start + us(25), 1}, start, true);
    }
    forecast.begin_at(us(20'000));
    EXPECT_NEAR(told.settle(), level_w - noise_w, tiny_w);
}

TEST_F(EnergyForecastTest, IsOverWhenAllHasEnded) {
    EXPECT_TRUE(forecast.is_over(us(0)));
    forecast.add_untold({1, us(1), us(10), 0.6 * level_w});
    EXPECT_FALSE(forecast.is_over(us(10)));
    EXPECT_TRUE(forecast.is_over(us(11)));
}

// Whatever comes, at any time the sum of what is told reaches the level if that of all does.
TEST(EnergyForecast, IsEnoughAtAnyTime) {
    struct Sent {
        EnergyForecast::Coming coming;
        SimTime sensed_from;
        bool is_told;
        bool is_loud;
    };
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        RandomStream draws(seed, 0, Purpose{1010});
        EnergyForecast forecast;
        forecast.begin(noise_w);
        std::vector<Sent> sent;
        const std::int64_t span_us = draws.uniform() < 0.5 ? 30 : 10'000;  // many in one moment, or few
        for (std::uint64_t id = 0; id < 40; ++id) {
            const SimTime now = us(static_cast<std::int64_t>(id));
            forecast.begin_at(now);
            const SimTime start = now + us(draws.uniform_int(5));
            const SimTime end = start + us(1 + draws.uniform_int(static_cast<std::uint32_t>(span_us)));
            const double power_w = level_w * draws.uniform() * draws.uniform() * 1.2;
            const bool is_loud = power_w + noise_w >= level_w;
            const bool is_told = is_loud || draws.uniform() < 0.3;
            const SimTime sensed_from = is_told ? start + us(draws.uniform_int(4)) : start;
            const EnergyForecast::Coming coming{id, start, end, power_w};
            is_told ? forecast.add_told(coming, sensed_from, is_loud) : forecast.add_untold(coming);
            sent.push_back({coming, sensed_from, is_told, is_loud});
            forecast.settle(level_w, [&sent](const EnergyForecast::Coming& told) {
                ASSERT_FALSE(sent[told.transmission].is_told);
                sent[told.transmission].is_told = true;
            });
            for (std::int64_t at_us = now.ps() / 1'000'000; at_us < 60; ++at_us) {
                const SimTime at = us(at_us) + SimTime::from_ns(500);
                double all_w = noise_w;
                double told_w = noise_w;
                bool has_untold = false;
                for (const Sent& one : sent) {
                    const bool is_sensed = at >= one.sensed_from;
                    if (at < one.coming.start || at >= one.coming.end || (one.is_loud && !is_sensed)) {
                        continue;
                    }
                    all_w += one.coming.power_w;
                    told_w += one.is_told && is_sensed ? one.coming.power_w : 0;
                    has_untold |= !one.is_told;
                }
                EXPECT_TRUE(told_w >= level_w || all_w < level_w || !has_untold) << seed << ", " << at_us;
            }
        }
    }
}

}  // namespace
}  // namespace netsim
