#include "netsim/mac/arf_rate_control.hpp"

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"

namespace netsim {
namespace {

constexpr SimTime interval = SimTime::from_us(50'000);
constexpr SimTime step = SimTime::from_us(100);  // between two attempts

constexpr ArfRateControl::Parameters arf{interval, 10, 2};
constexpr ArfRateControl::Parameters aarf{interval, 10, 2, 2, 50};

// One 802.11a station, at 24 Mbps at first, that sends continuously.
class Attempts {
public:
    explicit Attempts(const ArfRateControl::Parameters& parameters, const char* op_mode = "a",
                      double initial_bps = 24e6)
        : control(mode_set(op_mode), mode_set(op_mode).mode_for_bitrate(initial_bps), parameters) {}

    double mode_mbps(NodeId destination = 1) {
        return static_cast<double>(control.mode_for({destination, 100, 0}, now).bitrate_bps) / 1e6;
    }
    // Rate of each attempt in Mbps; '+' is a success, '-' a failure.
    std::vector<double> rates(std::string_view outcomes, NodeId destination = 1) {
        std::vector<double> used;
        for (const char outcome : outcomes) {
            const RateAttempt attempt{destination, 100, 0};
            const Mode& mode = control.mode_for(attempt, now);
            used.push_back(static_cast<double>(mode.bitrate_bps) / 1e6);
            outcome == '+' ? control.succeeded(attempt, mode, now) : control.failed(attempt, mode, now);
            now = now + step;
        }
        return used;
    }
    double rate_after(std::string_view outcomes) {
        rates(outcomes);
        return mode_mbps();
    }

    ArfRateControl control;
    SimTime now = SimTime::from_us(1'000'000);
};

std::string successes(int count) {
    return std::string(static_cast<std::size_t>(count), '+');
}

struct Script {
    const char* name;
    std::string outcomes;
    double rate_mbps;  // rate of the next attempt
};

class ArfScript : public testing::TestWithParam<Script> {};

TEST_P(ArfScript, LeadsToTheRateOfThePaper) {
    EXPECT_EQ(Attempts(arf).rate_after(GetParam().outcomes), GetParam().rate_mbps);
}

INSTANTIATE_TEST_SUITE_P(
    Table, ArfScript,
    testing::Values(Script{"Nothing", "", 24}, Script{"NineSuccesses", successes(9), 24},
                    Script{"TenSuccesses", successes(10), 36}, Script{"OneFailure", "-", 24},
                    Script{"TwoFailures", "--", 18}, Script{"FailuresApart", "-+-+-", 24},
                    Script{"FourFailures", "----", 12}, Script{"ABrokenRow", "+++++++++-+", 24},
                    Script{"AProbeThatFails", successes(10) + "-", 24},
                    Script{"AProbeThatSucceeds", successes(11) + "-", 36},
                    Script{"AfterTheProbeTwoFailures", successes(11) + "--", 24},
                    Script{"TenMoreSuccesses", successes(20), 48},
                    Script{"ASecondProbe", successes(10) + "-" + successes(10), 36},
                    Script{"TheSlowest", std::string(100, '-'), 6}, Script{"TheFastest", successes(300), 54}),
    [](const auto& test) { return test.param.name; });

TEST(ArfRateControl, EveryProbeThatFailsIsFollowedByAnotherOne) {
    Attempts attempts(arf);
    for (int probe = 0; probe < 5; ++probe) {
        EXPECT_EQ(attempts.rate_after(successes(9)), 24);
        EXPECT_EQ(attempts.rate_after("+"), 36);
        EXPECT_EQ(attempts.rate_after("-"), 24);
    }
}

TEST(AarfRateControl, EveryProbeThatFailsDoublesTheSuccessesBeforeTheNextOneUpToFifty) {
    Attempts attempts(aarf);
    for (const int threshold : {10, 20, 40, 50, 50}) {
        EXPECT_EQ(attempts.rate_after(successes(threshold - 1)), 24) << threshold;
        EXPECT_EQ(attempts.rate_after("+"), 36) << threshold;
        EXPECT_EQ(attempts.rate_after("-"), 24) << threshold;
    }
}

TEST(AarfRateControl, FailuresInARowSetTheNumberOfSuccessesBack) {
    Attempts attempts(aarf);
    attempts.rates(successes(10) + "-");
    EXPECT_EQ(attempts.rate_after(successes(10)), 24);
    EXPECT_EQ(attempts.rate_after("--"), 18);
    EXPECT_EQ(attempts.rate_after(successes(10)), 24);
}

TEST(AarfRateControl, AFactorOfOneIsArf) {
    Attempts attempts({interval, 10, 2, 1, 50});
    attempts.rates(successes(10) + "-");
    EXPECT_EQ(attempts.rate_after(successes(10)), 36);
}

TEST(ArfRateControl, AfterTheIntervalTheNextFasterRateIsProbed) {
    Attempts attempts(arf);
    attempts.rates("+");
    attempts.now = attempts.now + interval;
    EXPECT_EQ(attempts.rates("-+"), (std::vector<double>{36, 24}));
}

TEST(ArfRateControl, TheIntervalBeginsAnewAtEveryChange) {
    Attempts attempts(arf);
    attempts.rates("+");
    attempts.now = attempts.now + SimTime::from_us(40'000);
    EXPECT_EQ(attempts.rate_after("--"), 18);
    attempts.now = attempts.now + SimTime::from_us(40'000);
    EXPECT_EQ(attempts.mode_mbps(), 18);
    attempts.now = attempts.now + SimTime::from_us(10'000);
    EXPECT_EQ(attempts.mode_mbps(), 24);
}

TEST(ArfRateControl, TheIntervalBeginsAnewAtAnIncreaseToo) {
    Attempts attempts(arf);
    attempts.rates("+");
    attempts.now = attempts.now + interval;
    EXPECT_EQ(attempts.rates("++"), (std::vector<double>{36, 36}));
    attempts.now = attempts.now + interval - step * 3;
    EXPECT_EQ(attempts.mode_mbps(), 36);
    attempts.now = attempts.now + step;
    EXPECT_EQ(attempts.mode_mbps(), 48);
}

TEST(ArfRateControl, EachDestinationHasARateOfItsOwn) {
    Attempts attempts(arf);
    attempts.rates("----", 1);
    attempts.rates(successes(10), 2);
    EXPECT_EQ(attempts.mode_mbps(1), 12);
    EXPECT_EQ(attempts.mode_mbps(2), 36);
    EXPECT_EQ(attempts.mode_mbps(3), 24);
}

TEST(ArfRateControl, TheRatesOfMixedModeAreThoseOfAllGenerationsByBitrate) {
    Attempts attempts(arf, "g(mixed)", 1e6);
    std::vector<double> rates{attempts.mode_mbps()};
    for (int raise = 0; raise < 12; ++raise) {
        rates.push_back(attempts.rate_after(successes(10)));
    }
    EXPECT_EQ(rates, (std::vector<double>{1, 2, 5.5, 6, 9, 11, 12, 18, 24, 36, 48, 54, 54}));
}

// For any outcomes: only neighbors in the mode set, up only after a success or the interval, down
// only after a failure.
TEST(ArfRateControl, TheRateMovesByOneStepInTheDirectionOfWhatHappened) {
    for (const ArfRateControl::Parameters& parameters : {arf, aarf}) {
        for (const char* op_mode : {"a", "b", "g(erp)", "g(mixed)"}) {
            const ModeSet& modes = mode_set(op_mode);
            ArfRateControl control(modes, modes.fastest_mandatory(), parameters);
            RandomStream draws(1, 0, Purpose{1001});
            const RateAttempt attempt{1, 100, 0};
            SimTime now;
            const Mode* before = &control.mode_for(attempt, now);
            for (int i = 0; i < 5000; ++i) {
                const bool success = draws.uniform() < 0.5 + 0.45 * (i / 500 % 2);
                success ? control.succeeded(attempt, *before, now) : control.failed(attempt, *before, now);
                const bool waits = draws.uniform() < 0.01;
                const Mode* at_once = &control.mode_for(attempt, now);
                const auto moved = at_once - before;
                ASSERT_LE(std::abs(moved), 1);
                ASSERT_TRUE(moved == 0 || (moved > 0) == success);
                now = now + (waits ? interval : step);
                const Mode* after = &control.mode_for(attempt, now);
                ASSERT_TRUE(after - at_once == 0 || after - at_once == 1);
                ASSERT_LT(modes.index_of(*after), modes.modes().size());
                before = after;
            }
        }
    }
}

}  // namespace
}  // namespace netsim
