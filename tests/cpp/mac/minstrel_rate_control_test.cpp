#include "netsim/mac/minstrel_rate_control.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"

namespace netsim {
namespace {

using Shares = std::array<double, 8>;  // of successes at 6, 9, 12, 18, 24, 36, 48 and 54 Mbps

constexpr SimTime update_interval = SimTime::from_us(100'000);
constexpr int limit = 7;
constexpr int psdu_bytes = 1064;

const ModeSet& modes() {
    return mode_set("a");
}

// What one attempt takes on a free channel in 802.11a, written out: DIFS 34 µs, 7.5 slots of 9 µs, SIFS 16 µs.
double attempt_us(std::size_t mode) {
    constexpr std::array<int, 8> data_us{1444, 968, 732, 496, 380, 260, 200, 180};
    constexpr std::array<int, 8> ack_us{44, 44, 32, 32, 28, 28, 28, 28};
    return 34 + 67.5 + data_us.at(mode) + 16 + ack_us.at(mode);
}

std::size_t best_mode(const Shares& shares) {
    std::size_t best = 0;
    for (std::size_t mode = 1; mode < shares.size(); ++mode) {
        if (shares.at(mode) / attempt_us(mode) > shares.at(best) / attempt_us(best)) {
            best = mode;
        }
    }
    return best;
}

// A link on which a frame succeeds with the given chance of its rate. Frames follow each other without a pause.
class LossyLink {
public:
    LossyLink(std::uint64_t seed, double look_around)
        : control(modes(), modes().fastest_mandatory(), {update_interval, look_around, 0.75},
                  RandomStream(seed, 0, Purpose::rate_control)),
          luck_(seed, 0, Purpose{1002}) {}

    // The modes of the attempts of one frame; the frame ends with its first success.
    std::vector<std::size_t> send(const Shares& shares) {
        std::vector<std::size_t> used;
        for (int number = 0; number < limit; ++number) {
            const RateAttempt attempt{1, psdu_bytes, number, limit};
            const Mode& mode = control.mode_for(attempt, now);
            used.push_back(modes().index_of(mode));
            now = now + SimTime::from_us(static_cast<std::int64_t>(attempt_us(used.back())));
            if (luck_.uniform() < shares.at(used.back())) {
                control.succeeded(attempt, mode, now);
                ++delivered;
                break;
            }
            control.failed(attempt, mode, now);
        }
        return used;
    }
    void run(const Shares& shares, SimTime duration) {
        const SimTime end = now + duration;
        while (now < end) {
            for (const std::size_t mode : send(shares)) {
                ++attempts.at(mode);
            }
        }
    }
    double share_at(std::size_t mode) const {
        std::uint64_t all = 0;
        for (const std::uint64_t count : attempts) {
            all += count;
        }
        return static_cast<double>(attempts.at(mode)) / static_cast<double>(all);
    }

    MinstrelRateControl control;
    SimTime now;
    std::uint64_t delivered = 0;
    std::array<std::uint64_t, 8> attempts{};

private:
    RandomStream luck_;
};

// Rates up to one work, those above it hardly ever.
Shares cliff_after(std::size_t last) {
    Shares shares{};
    for (std::size_t mode = 0; mode < shares.size(); ++mode) {
        shares.at(mode) = mode <= last ? 0.98 : 0.01;
    }
    return shares;
}

class MinstrelCliff : public testing::TestWithParam<std::size_t> {};

// Of 3000 attempts at least at a steady state, 10 % of frames try something else at one of their attempts, which fails if
// it is too fast: with four standard deviations (2 %) to spare, 85 % of all attempts are at the best rate. A wrong
// choice by chance would need several windows in which a rate with 1 % success does nothing but succeed:
// below 1e-6 in total.
TEST_P(MinstrelCliff, MostAttemptsAreAtTheRateWithTheBestThroughput) {
    const Shares shares = cliff_after(GetParam());
    ASSERT_EQ(best_mode(shares), GetParam());
    LossyLink link(1, 0.1);
    link.run(shares, SimTime::from_seconds(3));
    link.attempts = {};
    link.run(shares, SimTime::from_seconds(5));
    EXPECT_GE(link.share_at(GetParam()), 0.85);
}

INSTANTIATE_TEST_SUITE_P(Rates, MinstrelCliff, testing::Range<std::size_t>(0, 8),
                         [](const auto& test) { return std::to_string(test.param); });

// Losses that grow with the rate, so that the second best is only some 10 % worse.
TEST(MinstrelRateControl, ThroughputIsCloseToThatOfTheBestRateWhereLossesGrowWithTheRate) {
    const Shares shares{1, 1, 0.99, 0.97, 0.9, 0.75, 0.4, 0.1};
    const double best_per_s = shares.at(best_mode(shares)) / attempt_us(best_mode(shares)) * 1e6;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        LossyLink link(seed, 0.1);
        link.run(shares, SimTime::from_seconds(2));
        link.delivered = 0;
        link.run(shares, SimTime::from_seconds(5));
        EXPECT_GE(static_cast<double>(link.delivered) / 5, 0.85 * best_per_s) << seed;
    }
}

TEST(MinstrelRateControl, FindsTheBestRateAgainWhenTheChannelChanges) {
    LossyLink link(2, 0.1);
    for (const std::size_t last : {7U, 1U, 5U}) {
        link.run(cliff_after(last), SimTime::from_seconds(5));
        link.attempts = {};
        link.run(cliff_after(last), SimTime::from_seconds(2));
        EXPECT_GE(link.share_at(last), 0.8) << last;
    }
}

TEST(MinstrelRateControl, WithoutLookAroundItStaysAtItsFirstRateWhileThatSucceeds) {
    LossyLink link(1, 0);
    Shares shares{};
    shares.fill(1);
    link.run(shares, SimTime::from_seconds(1));
    EXPECT_EQ(link.share_at(4), 1);
}

TEST(MinstrelRateControl, TheFirstFramesAreAtTheInitialRateAndAtLastAtTheSlowest) {
    LossyLink link(1, 0);
    EXPECT_EQ(link.send(Shares{}), (std::vector<std::size_t>{4, 4, 4, 4, 4, 4, 0}));
}

TEST(MinstrelRateControl, WhereNothingSucceedsItIsTheSlowest) {
    LossyLink link(1, 0);
    link.run(Shares{}, update_interval);
    EXPECT_EQ(link.send(Shares{}), std::vector<std::size_t>(limit, 0));
}

// Every rate has been tried: 54 Mbps is best, 48 second, 6 Mbps the most likely.
TEST(MinstrelRateControl, TheAttemptsOfAFrameGoDownTheChain) {
    MinstrelRateControl control(modes(), modes().fastest_mandatory(), {update_interval, 0, 0.75},
                                RandomStream(1, 0, Purpose::rate_control));
    const Shares shares{0.9, 0.8, 0.8, 0.8, 0.8, 0.8, 0.8, 0.8};
    SimTime now;
    for (std::size_t mode = 0; mode < shares.size(); ++mode) {
        for (int i = 0; i < 10; ++i) {
            const RateAttempt attempt{1, psdu_bytes, 0, limit};
            i < 10 * shares.at(mode) ? control.succeeded(attempt, modes().modes()[mode], now)
                                     : control.failed(attempt, modes().modes()[mode], now);
        }
    }
    now = update_interval;
    const auto chain = [&](int attempts) {
        std::vector<std::size_t> used;
        for (int number = 0; number < attempts; ++number) {
            used.push_back(modes().index_of(control.mode_for({1, psdu_bytes, number, attempts}, now)));
        }
        return used;
    };
    EXPECT_EQ(chain(7), (std::vector<std::size_t>{7, 7, 6, 6, 0, 0, 0}));
    EXPECT_EQ(chain(4), (std::vector<std::size_t>{7, 6, 0, 0}));
    EXPECT_EQ(chain(1), std::vector<std::size_t>{7});
}

// 10000 frames, one in ten tries another of seven rates: 1000 ± 30; five standard deviations are allowed, a false
// alarm in 2 million.
TEST(MinstrelRateControl, LooksAroundWithTheShareOfFramesThatItIsTold) {
    LossyLink link(3, 0.1);
    const Shares shares = cliff_after(0);
    link.run(shares, SimTime::from_seconds(1));
    std::map<std::size_t, int> tried;
    for (int frame = 0; frame < 10'000; ++frame) {
        ++tried[link.send(shares).front()];
    }
    EXPECT_NEAR(10'000 - tried[0], 1000, 150);
    for (std::size_t mode = 1; mode < shares.size(); ++mode) {
        EXPECT_NEAR(tried[mode], 1000.0 / 7, 60) << mode;
    }
}

TEST(MinstrelRateControl, ASlowerRateIsTriedOnlyAfterTheBestOneFailed) {
    LossyLink link(4, 1);
    const Shares shares = cliff_after(7);
    link.run(shares, SimTime::from_seconds(2));
    for (int frame = 0; frame < 1000; ++frame) {
        const std::vector<std::size_t> used = link.send(shares);
        ASSERT_EQ(used.front(), 7U);
        ASSERT_TRUE(used.size() < 2 || used[1] == 7U);
    }
}

TEST(MinstrelRateControl, EachDestinationHasStatisticsOfItsOwn) {
    LossyLink link(5, 0.1);
    link.run(cliff_after(0), SimTime::from_seconds(2));
    const RateAttempt to_another{2, psdu_bytes, 1, limit};
    EXPECT_EQ(link.control.mode_for(to_another, link.now).bitrate_bps, 24'000'000);
}

TEST(MinstrelRateControl, TheSameSeedChoosesTheSameRates) {
    const auto rates_of = [](std::uint64_t seed) {
        LossyLink link(seed, 0.1);
        std::vector<std::size_t> rates;
        for (int frame = 0; frame < 500; ++frame) {
            rates.push_back(link.send(cliff_after(4)).front());
        }
        return rates;
    };
    EXPECT_EQ(rates_of(1), rates_of(1));
    EXPECT_NE(rates_of(1), rates_of(2));
}

}  // namespace
}  // namespace netsim
