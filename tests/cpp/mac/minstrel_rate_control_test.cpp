#include "netsim/mac/minstrel_rate_control.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>
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

ResponseModes responses() {
    MacConfig config;
    config.op_mode = "a";
    return ResponseModes(config);
}

// Duration of one attempt on a free channel in 802.11a: DIFS 34 µs, 7.5 slots of 9 µs, SIFS
// 16 µs.
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

// A link on which a frame succeeds with the given probability of its rate. Frames follow each
// other without a pause.
class LossyLink {
public:
    LossyLink(std::uint64_t seed, double look_around)
        : control(modes(), responses(), modes().fastest_mandatory(), {update_interval, look_around, 0.75},
                  RandomStream(seed, 0, Purpose::rate_control)),
          luck_(seed, 0, Purpose{1002}) {}

    // The modes of the attempts of one frame; the frame ends with its first success.
    std::vector<std::size_t> send(const Shares& shares) {
        std::vector<std::size_t> used;
        for (int number = 0; number < limit; ++number) {
            const RateAttempt attempt{1, psdu_bytes, number};
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

// Rates up to one succeed, those above it hardly ever.
Shares cliff_after(std::size_t last) {
    Shares shares{};
    for (std::size_t mode = 0; mode < shares.size(); ++mode) {
        shares.at(mode) = mode <= last ? 0.98 : 0.01;
    }
    return shares;
}

class MinstrelCliff : public testing::TestWithParam<std::size_t> {};

// Of at least 3000 attempts in a steady state, 10 % of frames try another rate in one attempt,
// which fails if the rate is too high. With four standard deviations (2 %) of margin, 85 % of all
// attempts are at the best rate. A wrong choice needs several windows in which all attempts of a
// rate with 1 % success succeed: below 1e-6 in total.
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

// Losses that grow with the rate, so that the second best rate is only some 10 % worse.
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

// Fifty attempts at each rate, with that ratio of successes, and an update after them.
class LearnedLink {
public:
    explicit LearnedLink(const Shares& shares, int bytes = psdu_bytes) : psdu_bytes_(bytes) {
        constexpr int attempts = 50;
        for (std::size_t mode = 0; mode < shares.size(); ++mode) {
            for (int i = 0; i < attempts; ++i) {
                const RateAttempt attempt{1, psdu_bytes_, 0};
                i < attempts* shares.at(mode) ? control_.succeeded(attempt, modes().modes()[mode], SimTime{})
                                              : control_.failed(attempt, modes().modes()[mode], SimTime{});
            }
        }
    }
    // The modes of the attempts of one frame that all fail.
    std::vector<std::size_t> chain(int attempts) {
        std::vector<std::size_t> used;
        for (int number = 0; number < attempts; ++number) {
            const RateAttempt attempt{1, psdu_bytes_, number};
            used.push_back(modes().index_of(control_.mode_for(attempt, update_interval)));
        }
        return used;
    }

private:
    int psdu_bytes_;
    MinstrelRateControl control_{modes(),
                                 responses(),
                                 modes().fastest_mandatory(),
                                 {update_interval, 0, 0.75},
                                 RandomStream(1, 0, Purpose::rate_control)};
};

std::vector<std::size_t> in_a_row(std::initializer_list<std::pair<int, std::size_t>> stages) {
    std::vector<std::size_t> attempts;
    for (const auto& [count, mode] : stages) {
        attempts.insert(attempts.end(), static_cast<std::size_t>(count), mode);
    }
    return attempts;
}

// 54 Mbps is the best rate, 48 the second, 9 Mbps the most reliable, 6 the slowest.
TEST(MinstrelRateControl, TheAttemptsOfAFrameGoDownTheChain) {
    LearnedLink link({0.8, 0.9, 0.8, 0.8, 0.8, 0.8, 0.8, 0.8});
    EXPECT_EQ(link.chain(20), in_a_row({{5, 7}, {5, 6}, {4, 1}, {6, 0}}));
}

class MinstrelStage : public testing::TestWithParam<std::pair<std::size_t, int>> {};

// n attempts take n (DIFS + data + SIFS + ACK) and mean backoffs of 67.5 µs, 207 µs, 490.5 µs, 1062
// µs, 2209.5 µs and 4509 µs together: three at 6 Mbps 5104.5 µs, four 7214 µs; five at 54 Mbps
// 3499.5 µs, six 6057 µs.
TEST_P(MinstrelStage, HasAsManyAttemptsAsFitInto6Ms) {
    const auto [mode, attempts] = GetParam();
    Shares shares{};
    shares.at(mode) = 0.9;
    EXPECT_EQ(LearnedLink(shares).chain(attempts + 1), in_a_row({{attempts, mode}, {1, 0}}));
}

INSTANTIATE_TEST_SUITE_P(Rates, MinstrelStage,
                         testing::Values(std::pair{1U, 4}, std::pair{2U, 4}, std::pair{3U, 5},
                                         std::pair{4U, 5}, std::pair{5U, 5}, std::pair{6U, 5},
                                         std::pair{7U, 5}),
                         [](const auto& test) { return std::to_string(test.param.first); });

// 54 Mbps never fails, 6 Mbps is second.
TEST(MinstrelRateControl, AtTheSlowestRateAStageHasThreeAttemptsOfAUsualFrame) {
    LearnedLink link({0.9, 0, 0, 0, 0, 0, 0, 1});
    EXPECT_EQ(link.chain(7), in_a_row({{2, 7}, {3, 0}, {2, 7}}));
}

// At 6 Mbps 2304 B take 3.1 ms.
TEST(MinstrelRateControl, AStageHasTwoAttemptsAlsoOfFramesThatTakeLonger) {
    LearnedLink link({0.9, 0, 0, 0, 0, 0, 0, 1}, 2304);
    EXPECT_EQ(link.chain(6), in_a_row({{2, 7}, {2, 0}, {2, 7}}));
}

TEST(MinstrelRateControl, OfARateThatAlwaysSucceedsTwoAttemptsAreEnough) {
    LearnedLink link({0.8, 0.8, 0.8, 0.8, 0.8, 0.8, 0.8, 1});
    EXPECT_EQ(link.chain(9), in_a_row({{2, 7}, {5, 6}, {2, 7}}));
}

// The mean of 24 Mbps falls below 10 % in eight updates by 0.75 each, and is still the largest.
// All others are unknown.
TEST(MinstrelRateControl, OfARateThatHardlyEverSucceedsTooAndOfUnknownOnes) {
    LossyLink link(1, 0);
    link.run(cliff_after(7), SimTime::from_seconds(1));
    link.run(Shares{}, update_interval * 20);
    EXPECT_EQ(link.send(Shares{}), in_a_row({{2, 4}, {2, 0}, {2, 4}, {1, 0}}));
}

TEST(MinstrelRateControl, TheMostLikelyRateIsTheFastestOfThoseThatSucceedNineteenTimesInTwenty) {
    LearnedLink with_some({1, 0.98, 0.96, 0.8, 0.8, 0.8, 0.8, 0.8});
    EXPECT_EQ(with_some.chain(13), in_a_row({{5, 7}, {5, 6}, {2, 2}, {1, 0}}));
    LearnedLink without({0.9, 0.94, 0.92, 0.8, 0.8, 0.8, 0.8, 0.8});
    EXPECT_EQ(without.chain(15), in_a_row({{5, 7}, {5, 6}, {4, 1}, {1, 0}}));
}

TEST(MinstrelRateControl, BesideTheSlowestRateAsTheBestOneThereIsASecondBest) {
    LearnedLink link({1, 0.5, 0, 0, 0, 0, 0, 0});
    EXPECT_EQ(link.chain(7), in_a_row({{2, 0}, {4, 1}, {1, 0}}));
}

// 10000 frames, one in ten tries another one of seven rates: 1000 ± 30. Five standard deviations
// are allowed, a false alarm in 2 million.
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

// 24 Mbps succeeds in two intervals, 54 Mbps is tried only in the second one.
TEST(MinstrelRateControl, OfARateThatWasNeverTriedTheFirstShareCountsInFull) {
    MinstrelRateControl control(modes(), responses(), modes().fastest_mandatory(), {update_interval, 0, 0.75},
                                RandomStream(1, 0, Purpose::rate_control));
    const RateAttempt attempt{1, psdu_bytes, 0};
    control.succeeded(attempt, modes().modes()[4], SimTime());
    EXPECT_EQ(modes().index_of(control.mode_for(attempt, update_interval)), 4U);
    control.succeeded(attempt, modes().modes()[4], update_interval);
    control.succeeded(attempt, modes().modes()[7], update_interval);
    EXPECT_EQ(modes().index_of(control.mode_for(attempt, update_interval * 2)), 7U);
}

TEST(MinstrelRateControl, AFrameTriesOneRateAtAllAttemptsOfTheSecondStage) {
    MinstrelRateControl control(modes(), responses(), modes().fastest_mandatory(), {update_interval, 1, 0.75},
                                RandomStream(6, 0, Purpose::rate_control));
    for (int frame = 0; frame < 100; ++frame) {
        std::vector<std::size_t> used;
        for (int number = 0; number < 4; ++number) {
            used.push_back(modes().index_of(control.mode_for({1, psdu_bytes, number}, SimTime())));
        }
        ASSERT_EQ(used[2], used[3]) << frame;
    }
}

TEST(MinstrelRateControl, EachDestinationHasStatisticsOfItsOwn) {
    LossyLink link(5, 0.1);
    link.run(cliff_after(0), SimTime::from_seconds(2));
    const RateAttempt to_another{2, psdu_bytes, 1};
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
