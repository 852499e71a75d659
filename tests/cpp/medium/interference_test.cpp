#include "netsim/medium/interference.hpp"

#include <algorithm>
#include <deque>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"

namespace netsim {
namespace {

constexpr SimTime us(std::int64_t microseconds) {
    return SimTime::from_us(microseconds);
}

// Frames of senders 0, 1, 2 … in a list that keeps their transmissions.
class Frames {
public:
    const Arrival& add(NodeId sender, SimTime start, SimTime end, double power_w) {
        Transmission& transmission = transmissions_.emplace_back();
        transmission.sender.node = sender;
        return all.emplace_back(Arrival{&transmission, start, end, power_w});
    }

    std::deque<Arrival> all;

private:
    std::deque<Transmission> transmissions_;
};

double sum_w(const Frames& frames, SimTime moment) {
    double sum_w = 0;
    for (const Arrival& frame : frames.all) {
        if (frame.start <= moment && moment < frame.end) {
            sum_w += frame.power_w;
        }
    }
    return sum_w;
}

// The definition, without any search: every start is looked at, and everything is added up there.
Interference plain_worst(const Frames& frames, SimTime start, SimTime end) {
    Interference worst;
    SimTime when;
    for (const Arrival& candidate : frames.all) {
        const SimTime moment = std::max(candidate.start, start);
        if (candidate.start < end && candidate.end > start && sum_w(frames, moment) > worst.max_power_w) {
            worst.max_power_w = sum_w(frames, moment);
            when = moment;
        }
    }
    for (const Arrival& frame : frames.all) {
        const NodeId sender = frame.transmission->sender.node;
        if (worst.max_power_w > 0 && frame.start <= when && when < frame.end &&
            std::ranges::find(worst.interferers, sender) == worst.interferers.end()) {
            worst.interferers.push_back(sender);
        }
    }
    return worst;
}

TEST(Interference, NothingDisturbsAReceptionAlone) {
    InterferenceSum sum;
    sum.begin(us(0), us(10));
    EXPECT_EQ(sum.worst().max_power_w, 0);
    EXPECT_EQ(sum.steps(), (std::vector<InterferenceStep>{{us(0), 0}}));
}

TEST(Interference, WhatTouchesThePeriodOnlyAtAnEndDoesNotDisturb) {
    InterferenceSum sum;
    Frames frames;
    sum.begin(us(10), us(20));
    sum.add(frames.add(1, us(0), us(10), 1));
    sum.add(frames.add(2, us(20), us(30), 1));
    EXPECT_EQ(sum.worst().max_power_w, 0);
}

TEST(Interference, StepsFollowStartsAndEnds) {
    InterferenceSum sum;
    Frames frames;
    sum.begin(us(10), us(20));
    sum.add(frames.add(1, us(0), us(15), 1));
    sum.add(frames.add(2, us(12), us(40), 2));
    sum.add(frames.add(3, us(15), us(16), 1));  // as another one of that power ends: no step
    EXPECT_EQ(sum.steps(), (std::vector<InterferenceStep>{{us(10), 1}, {us(12), 3}, {us(16), 2}}));
}

TEST(Interference, AWeakFrameIsNotLostBesideAStrongOne) {
    InterferenceSum sum;
    Frames frames;
    sum.begin(us(0), us(20));
    sum.add(frames.add(1, us(0), us(20), 1e-25));
    sum.add(frames.add(2, us(5), us(10), 1));
    EXPECT_EQ(sum.steps().back(), (InterferenceStep{us(10), 1e-25}));
}

class RandomFrames : public testing::TestWithParam<std::uint64_t> {
protected:
    RandomFrames() {
        RandomStream draws(GetParam(), 0, Purpose{1002});
        const std::uint32_t count = draws.uniform_int(12);
        const bool equal_powers = draws.uniform() < 0.5;
        sum.begin(us(20), us(40));
        for (std::uint32_t i = 0; i < count; ++i) {
            const SimTime start = us(draws.uniform_int(50));
            const SimTime end = start + us(1 + draws.uniform_int(30));
            const double power_w = equal_powers ? 0.1 : 1e-12 / (1e-6 + draws.uniform());
            sum.add(frames.add(static_cast<NodeId>(draws.uniform_int(5)), start, end, power_w));
        }
    }

    Frames frames;
    InterferenceSum sum;
};

TEST_P(RandomFrames, WorstIsThatOfThePlainSearchToTheLastBit) {
    const Interference expected = plain_worst(frames, us(20), us(40));
    EXPECT_EQ(sum.worst().max_power_w, expected.max_power_w);
    EXPECT_EQ(sum.worst().interferers, expected.interferers);
}

TEST_P(RandomFrames, StepsAreTheSumAtEveryMoment) {
    const auto& steps = sum.steps();
    EXPECT_EQ(steps.front().start, us(20));
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const SimTime until = i + 1 < steps.size() ? steps[i + 1].start : us(40);
        EXPECT_LT(steps[i].start, until);
        for (SimTime moment = steps[i].start; moment < until; moment = moment + us(1)) {
            EXPECT_NEAR(steps[i].power_w, sum_w(frames, moment), 1e-14 * sum_w(frames, moment));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Interference, RandomFrames, testing::Range<std::uint64_t>(0, 1000));

}  // namespace
}  // namespace netsim
