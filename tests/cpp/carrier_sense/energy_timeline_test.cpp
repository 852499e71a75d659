#include "netsim/carrier_sense/energy_timeline.hpp"

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"

namespace netsim {
namespace {

constexpr double level_w = 1e-12;
constexpr double noise_w = 1e-14;
constexpr double tiny_w = 1e-20;  // relative to the level

SimTime us(std::int64_t microseconds) {
    return SimTime::from_us(microseconds);
}

// The reported arrivals, by the ids of their transmissions.
struct Told {
    EnergyTimeline& timeline;
    std::vector<std::uint64_t> ids;

    double report_missing() {
        return timeline.report_missing(
            level_w, [this](const EnergyTimeline::Signal& signal) { ids.push_back(signal.transmission); });
    }
};

class EnergyTimelineTest : public testing::Test {
protected:
    EnergyTimelineTest() {
        timeline.begin(noise_w);
        timeline.begin_at(us(0));
    }

    EnergyTimeline timeline;
    Told notified{timeline, {}};
};

TEST_F(EnergyTimelineTest, HeadroomIsLevelMinusNoise) {
    EXPECT_NEAR(notified.report_missing(), level_w - noise_w, tiny_w);
}

TEST_F(EnergyTimelineTest, ArrivalsReduceTheHeadroom) {
    timeline.add_unreported({1, us(1), us(10), 0.3 * level_w});
    timeline.add_reported({2, us(5), us(15), 0.2 * level_w}, us(5), false);
    EXPECT_NEAR(notified.report_missing(), 0.5 * level_w - noise_w, tiny_w);
    EXPECT_TRUE(notified.ids.empty());
}

TEST_F(EnergyTimelineTest, ReportsTheStrongestAndNoMoreThanNeeded) {
    timeline.add_unreported({1, us(1), us(10), 0.3 * level_w});
    timeline.add_unreported({2, us(2), us(11), 0.5 * level_w});
    timeline.add_unreported({3, us(3), us(12), 0.8 * level_w});
    notified.report_missing();
    EXPECT_EQ(notified.ids, (std::vector<std::uint64_t>{3, 2}));
}

TEST_F(EnergyTimelineTest, ReportsEachOnce) {
    timeline.add_unreported({1, us(1), us(10), 0.6 * level_w});
    timeline.add_unreported({2, us(2), us(10), 0.6 * level_w});
    notified.report_missing();
    notified.ids.clear();
    notified.report_missing();
    EXPECT_TRUE(notified.ids.empty());
}

TEST_F(EnergyTimelineTest, HeadroomIsInfiniteWhereEnoughIsReported) {
    timeline.add_unreported({1, us(1), us(10), 0.6 * level_w});
    timeline.add_unreported({2, us(2), us(11), 0.7 * level_w});
    // Before and after the overlap, there is only one of them.
    EXPECT_NEAR(notified.report_missing(), 0.3 * level_w - noise_w, tiny_w);
    EXPECT_EQ(notified.ids.size(), 2U);
}

TEST_F(EnergyTimelineTest, ReportsOthersForTheTimeAfterAReportedOneEnds) {
    timeline.add_reported({1, us(0), us(5), 2 * level_w}, us(0), true);
    timeline.add_unreported({2, us(1), us(10), 0.6 * level_w});
    timeline.add_unreported({3, us(2), us(11), 0.7 * level_w});
    notified.report_missing();
    EXPECT_EQ(notified.ids, (std::vector<std::uint64_t>{3, 2}));
}

TEST_F(EnergyTimelineTest, ReportsTheLongestInsteadOfThoseThatEndBefore) {
    for (std::int64_t id = 1; id <= 6; ++id) {
        const double power_w = static_cast<double>(11 - id) / 10 * 0.95 * level_w;
        timeline.add_unreported({static_cast<std::uint64_t>(id), us(-1), us(10 + id), power_w});
    }
    notified.report_missing();
    EXPECT_EQ(notified.ids, (std::vector<std::uint64_t>{5, 6}));
}

TEST_F(EnergyTimelineTest, ConsecutiveArrivalsDoNotAddUp) {
    timeline.add_unreported({1, us(1), us(10), 0.6 * level_w});
    timeline.add_unreported({2, us(11), us(20), 0.7 * level_w});
    EXPECT_NEAR(notified.report_missing(), 0.3 * level_w - noise_w, tiny_w);
    EXPECT_TRUE(notified.ids.empty());
}

TEST_F(EnergyTimelineTest, AtOneInstantAllStartsAndEndsCountForTheTotal) {
    timeline.add_unreported({1, us(1), us(10), 0.6 * level_w});
    timeline.add_unreported({2, us(10), us(20), 0.6 * level_w});
    notified.report_missing();
    EXPECT_EQ(notified.ids.size(), 2U);
}

TEST_F(EnergyTimelineTest, AtOneInstantReportedStartsDoNotCount) {
    timeline.add_reported({1, us(5), us(15), 2 * level_w}, us(5), true);
    timeline.add_reported({2, us(5), us(15), 2 * level_w}, us(5), true);
    timeline.add_unreported({3, us(1), us(20), 0.1 * level_w});
    notified.report_missing();
    EXPECT_EQ(notified.ids, (std::vector<std::uint64_t>{3}));
}

TEST_F(EnergyTimelineTest, EndedArrivalsDoNotCount) {
    timeline.add_unreported({1, us(1), us(10), 0.6 * level_w});
    timeline.add_unreported({2, us(1), us(20), 0.1 * level_w});
    notified.report_missing();
    timeline.begin_at(us(11));
    EXPECT_NEAR(notified.report_missing(), 0.9 * level_w - noise_w, tiny_w);
    timeline.add_unreported({3, us(11), us(30), 0.7 * level_w});
    EXPECT_NEAR(notified.report_missing(), 0.2 * level_w - noise_w, tiny_w);
}

TEST_F(EnergyTimelineTest, ArrivalsThatBeganBeforeCount) {
    timeline.begin_at(us(10));
    timeline.add_unreported({1, us(1), us(20), 0.6 * level_w});
    EXPECT_NEAR(notified.report_missing(), 0.4 * level_w - noise_w, tiny_w);
}

TEST_F(EnergyTimelineTest, ArrivalsBeforeTheirDetectionDoNotSuffice) {
    timeline.add_reported({1, us(1), us(20), 0.95 * level_w}, us(5), false);
    timeline.add_unreported({2, us(1), us(4), 0.02 * level_w});
    timeline.add_unreported({3, us(1), us(4), 0.03 * level_w});
    notified.report_missing();
    EXPECT_EQ(notified.ids, (std::vector<std::uint64_t>{3, 2}));
}

TEST_F(EnergyTimelineTest, DetectedArrivalsSuffice) {
    timeline.add_reported({1, us(1), us(20), 0.98 * level_w}, us(5), false);
    timeline.add_unreported({2, us(6), us(21), 0.02 * level_w});
    timeline.add_unreported({3, us(7), us(22), 0.01 * level_w});
    notified.report_missing();
    EXPECT_EQ(notified.ids, (std::vector<std::uint64_t>{2}));
}

TEST_F(EnergyTimelineTest, OthersMatterUntilAStrongArrivalIsDetected) {
    timeline.add_reported({1, us(1), us(20), 2 * level_w}, us(5), true);
    timeline.add_unreported({2, us(2), us(4), 0.3 * level_w});
    EXPECT_NEAR(notified.report_missing(), 0.7 * level_w - noise_w, tiny_w);
    EXPECT_TRUE(notified.ids.empty());
    timeline.add_unreported({3, us(3), us(19), 0.8 * level_w});
    notified.report_missing();
    EXPECT_EQ(notified.ids, (std::vector<std::uint64_t>{3, 2}));
}

TEST_F(EnergyTimelineTest, AStrongArrivalThatEndsBeforeItsDetectionDoesNotCount) {
    timeline.add_reported({1, us(1), us(4), 2 * level_w}, us(5), true);
    EXPECT_NEAR(notified.report_missing(), level_w - noise_w, tiny_w);
}

TEST_F(EnergyTimelineTest, ReportedUntilTheyNoLongerSuffice) {
    timeline.add_reported({1, us(-1), us(10), 2 * level_w}, us(-1), true);
    timeline.add_reported({2, us(5), us(20), 0.6 * level_w}, us(5), false);
    timeline.add_reported({3, us(5), us(15), 0.6 * level_w}, us(5), false);
    EXPECT_EQ(timeline.reported_until(level_w), us(15));
}

TEST_F(EnergyTimelineTest, ReportedUntilNowIfTheyDoNotSuffice) {
    timeline.add_reported({1, us(1), us(10), 2 * level_w}, us(1), true);
    EXPECT_EQ(timeline.reported_until(level_w), us(0));
}

// It may not have started yet: events of one instant have an order.
TEST_F(EnergyTimelineTest, ReportedUntilNowIfTheyBeginNow) {
    timeline.add_reported({1, us(0), us(10), 2 * level_w}, us(0), true);
    EXPECT_EQ(timeline.reported_until(level_w), us(0));
}

TEST_F(EnergyTimelineTest, ReportedUntilOneEndsAsTheNextBegins) {
    timeline.add_reported({1, us(-1), us(10), 2 * level_w}, us(-1), true);
    timeline.add_reported({2, us(10), us(20), 2 * level_w}, us(10), true);
    EXPECT_EQ(timeline.reported_until(level_w), us(10));
}

TEST_F(EnergyTimelineTest, ReportedUntilTheLastStepIfTheNoiseSuffices) {
    EnergyTimeline exceeds_ed;
    exceeds_ed.begin(2 * level_w);
    exceeds_ed.begin_at(us(0));
    exceeds_ed.add_unreported({1, us(1), us(10), level_w});
    EXPECT_EQ(exceeds_ed.reported_until(level_w), us(10));
    exceeds_ed.begin_at(us(30));
    EXPECT_EQ(exceeds_ed.reported_until(level_w), us(30));
}

TEST_F(EnergyTimelineTest, KeepsSmallLevelsNextToLargePowers) {
    for (SimTime start; start < us(10'000); start += us(10)) {
        timeline.begin_at(start);
        timeline.add_reported({1, start, start + us(25), 1}, start, true);
    }
    timeline.begin_at(us(20'000));
    EXPECT_NEAR(notified.report_missing(), level_w - noise_w, tiny_w);
}

TEST_F(EnergyTimelineTest, IsOverWhenAllHasEnded) {
    EXPECT_TRUE(timeline.is_over(us(0)));
    timeline.add_unreported({1, us(1), us(10), 0.6 * level_w});
    EXPECT_FALSE(timeline.is_over(us(10)));
    EXPECT_TRUE(timeline.is_over(us(11)));
}

// At any time, the reported sum reaches the level if the total does.
TEST(EnergyTimeline, ReportedEnergySufficesAtAnyTime) {
    struct Sent {
        EnergyTimeline::Signal signal;
        SimTime sensed_from;
        bool is_reported;
        bool exceeds_ed;
    };
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        RandomStream draws(seed, 0, Purpose{1010});
        EnergyTimeline timeline;
        timeline.begin(noise_w);
        std::vector<Sent> sent;
        const std::int64_t span_us = draws.uniform() < 0.5 ? 30 : 10'000;  // many at one moment, or few
        for (std::uint64_t id = 0; id < 40; ++id) {
            const SimTime now = us(static_cast<std::int64_t>(id));
            timeline.begin_at(now);
            const SimTime start = now + us(draws.uniform_int(5));
            const SimTime end = start + us(1 + draws.uniform_int(static_cast<std::uint32_t>(span_us)));
            const double power_w = level_w * draws.uniform() * draws.uniform() * 1.2;
            const bool exceeds_ed = power_w + noise_w >= level_w;
            const bool is_reported = exceeds_ed || draws.uniform() < 0.3;
            const SimTime sensed_from = is_reported ? start + us(draws.uniform_int(4)) : start;
            const EnergyTimeline::Signal signal{id, start, end, power_w};
            is_reported ? timeline.add_reported(signal, sensed_from, exceeds_ed)
                        : timeline.add_unreported(signal);
            sent.push_back({signal, sensed_from, is_reported, exceeds_ed});
            timeline.report_missing(level_w, [&sent](const EnergyTimeline::Signal& notified) {
                ASSERT_FALSE(sent[notified.transmission].is_reported);
                sent[notified.transmission].is_reported = true;
            });
            for (std::int64_t at_us = now.ps() / 1'000'000; at_us < 60; ++at_us) {
                const SimTime at = us(at_us) + SimTime::from_ns(500);
                double all_w = noise_w;
                double reported_w = noise_w;
                bool has_untold = false;
                for (const Sent& one : sent) {
                    const bool is_sensed = at >= one.sensed_from;
                    if (at < one.signal.start || at >= one.signal.end || (one.exceeds_ed && !is_sensed)) {
                        continue;
                    }
                    all_w += one.signal.power_w;
                    reported_w += one.is_reported && is_sensed ? one.signal.power_w : 0;
                    has_untold |= !one.is_reported;
                }
                EXPECT_TRUE(reported_w >= level_w || all_w < level_w || !has_untold) << seed << ", " << at_us;
            }
        }
    }
}

}  // namespace
}  // namespace netsim
