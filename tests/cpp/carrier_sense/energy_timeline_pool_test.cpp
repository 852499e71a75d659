#include "netsim/carrier_sense/energy_timeline_pool.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr double noise_w = 1e-14;
constexpr double level_w = 1e-12;

SimTime us(std::int64_t microseconds) {
    return SimTime::from_us(microseconds);
}

class EnergyTimelinePoolTest : public testing::Test {
protected:
    EnergyTimelinePoolTest() {
        for (int radio = 0; radio < radios; ++radio) {
            timelines.add_radio();
        }
    }
    ReceiverTimeline& with_one_until(RadioId radio, SimTime start, SimTime end) {
        ReceiverTimeline& known = timelines.of(radio, noise_w, start);
        known.timeline.begin_at(start);
        known.timeline.add_unreported({1, start, end, level_w / 2});
        return known;
    }

    static constexpr int radios = 100;
    EnergyTimelinePool timelines;
};

TEST_F(EnergyTimelinePoolTest, HasNoTimelineAtFirst) {
    timelines.of(1, noise_w, us(0));
    EXPECT_TRUE(timelines.has(1));
    EXPECT_FALSE(timelines.has(0));
}

TEST_F(EnergyTimelinePoolTest, ANewTimelineHasNoiseOnly) {
    ReceiverTimeline& known = timelines.of(1, noise_w, us(5));
    EXPECT_EQ(known.next_id, 0U);
    EXPECT_EQ(known.deferred_until, SimTime::long_ago());
    known.timeline.begin_at(us(5));
    EXPECT_NEAR(known.timeline.report_missing(level_w, [](const auto&) {}), level_w - noise_w, 1e-20);
}

TEST_F(EnergyTimelinePoolTest, KeepsATimelineWhileAnArrivalLasts) {
    ReceiverTimeline& first = with_one_until(0, us(0), us(1000));
    for (RadioId radio = 1; radio < radios; ++radio) {
        with_one_until(radio, us(radio), us(1000));
    }
    EXPECT_EQ(&timelines.of(0, noise_w, us(999)), &first);
    EXPECT_EQ(first.radio, 0);
}

TEST_F(EnergyTimelinePoolTest, ReusesTimelinesThatAreOver) {
    for (RadioId radio = 0; radio < radios; ++radio) {
        const SimTime start = us(10) * radio;
        ReceiverTimeline& known = with_one_until(radio, start, start + us(5));
        known.next_id = 7;
        known.deferred_until = start + us(3);
    }
    EXPECT_LE(timelines.capacity(), 2U);
    EXPECT_FALSE(timelines.has(0));
    ReceiverTimeline& again = timelines.of(0, noise_w, us(2000));
    EXPECT_EQ(again.next_id, 0U);
    EXPECT_EQ(again.deferred_until, SimTime::long_ago());
}

}  // namespace
}  // namespace netsim
