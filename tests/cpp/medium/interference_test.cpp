#include "netsim/medium/interference.hpp"

#include <algorithm>
#include <deque>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"
#include "netsim/medium/arrival.hpp"

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

struct Worst {
    double sum_w = 0;
    std::vector<NodeId> interferers;
};

// The definition, without a search: sums at every start. A node is an interferer if the others that
// are at least as strong do not exceed the rest without it.
Worst plain_worst(const Frames& frames, SimTime start, SimTime end) {
    Worst worst;
    SimTime when;
    for (const Arrival& candidate : frames.all) {
        const SimTime moment = std::max(candidate.start, start);
        if (candidate.start < end && candidate.end > start && sum_w(frames, moment) > worst.sum_w) {
            worst.sum_w = sum_w(frames, moment);
            when = moment;
        }
    }
    std::vector<Arrival> present;
    for (const Arrival& frame : frames.all) {
        if (worst.sum_w > 0 && frame.start <= when && when < frame.end) {
            present.push_back(frame);
        }
    }
    std::ranges::stable_sort(present, std::greater(), &Arrival::power_w);
    for (const Arrival& frame : present) {
        double stronger_w = 0;
        for (const Arrival& other : present) {
            stronger_w += other.power_w > frame.power_w ? other.power_w : 0;
        }
        const NodeId sender = frame.transmission->sender.node;
        if (stronger_w <= worst.sum_w - stronger_w &&
            std::ranges::find(worst.interferers, sender) == worst.interferers.end()) {
            worst.interferers.push_back(sender);
        }
    }
    return worst;
}

TEST(Interference, IsZeroForASingleFrame) {
    InterferenceSum sum;
    sum.begin(us(0), us(10));
    EXPECT_EQ(sum.worst_w(), 0);
    EXPECT_EQ(sum.steps(), (std::vector<InterferenceStep>{{us(0), 0}}));
}

TEST(Interference, IgnoresFramesThatOnlyTouchThePeriod) {
    InterferenceSum sum;
    Frames frames;
    sum.begin(us(10), us(20));
    sum.add(frames.add(1, us(0), us(10), 1));
    sum.add(frames.add(2, us(20), us(30), 1));
    EXPECT_EQ(sum.worst_w(), 0);
}

TEST(Interference, StepsFollowStartsAndEnds) {
    InterferenceSum sum;
    Frames frames;
    sum.begin(us(10), us(20));
    sum.add(frames.add(1, us(0), us(15), 1));
    sum.add(frames.add(2, us(12), us(40), 2));
    sum.add(frames.add(3, us(15), us(16), 1));  // another one of that power ends at this time: no step
    EXPECT_EQ(sum.steps(), (std::vector<InterferenceStep>{{us(10), 1}, {us(12), 3}, {us(16), 2}}));
}

TEST(Interference, KeepsAWeakFrameNextToAStrongOne) {
    InterferenceSum sum;
    Frames frames;
    sum.begin(us(0), us(20));
    sum.add(frames.add(1, us(0), us(20), 1e-25));
    sum.add(frames.add(2, us(5), us(10), 1));
    EXPECT_EQ(sum.steps().back(), (InterferenceStep{us(10), 1e-25}));
}

// Interferers 1, 2, … with those powers, all on the air at the same time.
std::vector<NodeId> named_of(const std::vector<double>& powers_w) {
    InterferenceSum sum;
    Frames frames;
    sum.begin(us(0), us(20));
    NodeId sender = 0;
    for (const double power_w : powers_w) {
        sum.add(frames.add(++sender, us(5), us(10), power_w));
    }
    return sum.interferers();
}

TEST(Interferers, ExcludeWeakOnesOutweighedByOne) {
    EXPECT_EQ(named_of({1, 2, 10, 3}), (std::vector<NodeId>{3}));
}

TEST(Interferers, IncludeEnoughToOutweighTheRest) {
    EXPECT_EQ(named_of({1, 5, 4, 3}), (std::vector<NodeId>{2, 3}));
}

TEST(Interferers, IncludeThoseAsStrongAsTheLast) {
    EXPECT_EQ(named_of({4, 1, 4, 4}), (std::vector<NodeId>{1, 3, 4}));
}

TEST(Interferers, AreEmptyWithoutInterference) {
    EXPECT_TRUE(named_of({}).empty());
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

TEST_P(RandomFrames, WorstMomentMatchesThePlainSearch) {
    const Worst expected = plain_worst(frames, us(20), us(40));
    EXPECT_EQ(sum.worst_w(), expected.sum_w);
    EXPECT_EQ(sum.interferers(), expected.interferers);
    if (expected.sum_w > 0) {
        double of_all_w = 0;
        for (NodeId sender = 0; sender < 5; ++sender) {
            of_all_w += sum.worst_w_of(sender);
        }
        EXPECT_DOUBLE_EQ(of_all_w, expected.sum_w);
    }
}

TEST_P(RandomFrames, StepsMatchTheSumAtEveryMoment) {
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

// Frames from 2 to 6 µs with 1 W and from 4 to 8 µs with 2 W, and noise of 5 W from 5 µs on, of 1 W before.
class WithNoise : public testing::Test {
protected:
    WithNoise() {
        frames_.add(1, us(2), us(6), 1);
        frames_.add(2, us(4), us(8), 2);
        sum.begin(us(0), us(10));
        for (const Arrival& frame : frames_.all) {
            sum.add(frame);
        }
        sum.add_noise(us(0), 1);
        sum.add_noise(us(5), 5);
    }

    InterferenceSum sum;

private:
    Frames frames_;
};

TEST_F(WithNoise, TheWorstMomentIsThatOfTheWholeSum) {
    EXPECT_EQ(sum.worst_w(), 1 + 2 + 5);
    EXPECT_EQ(sum.worst_frames_w(), 1 + 2);
    EXPECT_EQ(sum.worst_noise_w(), 5);
    EXPECT_EQ(sum.worst_w_of(1), 1);
    EXPECT_EQ(sum.interferers(), std::vector<NodeId>{2});
}

TEST_F(WithNoise, NoiseAloneMayBeTheWorst) {
    sum.add_noise(us(9), 20);
    EXPECT_EQ(sum.worst_w(), 20);
    EXPECT_EQ(sum.worst_frames_w(), 1 + 2);
    EXPECT_EQ(sum.worst_noise_w(), 5);
}

TEST_F(WithNoise, StepsHaveBoth) {
    const std::vector<InterferenceStep> expected{{us(0), 1}, {us(2), 2}, {us(4), 4},
                                                 {us(5), 8}, {us(6), 7}, {us(8), 5}};
    EXPECT_EQ(sum.steps(), expected);
}

TEST(InterferenceSum, NoiseWithoutFrames) {
    InterferenceSum sum;
    sum.begin(us(0), us(10));
    sum.add_noise(us(0), 3);
    sum.add_noise(us(5), 2);
    EXPECT_EQ(sum.worst_w(), 3);
    EXPECT_EQ(sum.worst_noise_w(), 3);
    EXPECT_EQ(sum.worst_frames_w(), 0);
    EXPECT_TRUE(sum.interferers().empty());
    sum.begin(us(0), us(10));
    EXPECT_EQ(sum.worst_w(), 0);
}

}  // namespace
}  // namespace netsim
