#include "netsim/kernel/sim_time.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "netsim/error.hpp"

namespace netsim {
namespace {

TEST(SimTime, UnitsAreExact) {
    static_assert(SimTime::from_ns(3).ps() == 3'000);
    static_assert(SimTime::from_us(3).ps() == 3'000'000);
    static_assert(SimTime().ps() == 0);
}

TEST(SimTime, SecondsRoundToTheNearestPicosecond) {
    EXPECT_EQ(SimTime::from_seconds(1e-12).ps(), 1);
    EXPECT_EQ(SimTime::from_seconds(1.4e-12).ps(), 1);
    EXPECT_EQ(SimTime::from_seconds(1.6e-12).ps(), 2);
    EXPECT_EQ(SimTime::from_seconds(-1.6e-12).ps(), -2);
    // 0.1 is not a binary fraction, yet ten of them are one second.
    EXPECT_EQ(SimTime::from_seconds(0.1) * 10, SimTime::from_seconds(1));
}

TEST(SimTime, SecondsRoundTrip) {
    for (const double seconds : {0.0, 1e-12, 0.3, 12.5, 3600.000000000001, 9.2e6, -9.2e6}) {
        EXPECT_DOUBLE_EQ(SimTime::from_seconds(seconds).seconds(), seconds);
    }
}

TEST(SimTime, RefusesWhatIsNotRepresentable) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double seconds : {std::nan(""), infinity, -infinity, 9.3e6, -9.3e6}) {
        EXPECT_THROW(SimTime::from_seconds(seconds), SimulationError) << seconds;
    }
}

TEST(SimTime, TheErrorNamesValueAndRange) {
    try {
        SimTime::from_seconds(1e7);
        FAIL() << "no error";
    } catch (const SimulationError& error) {
        EXPECT_EQ(std::string(error.what()),
                  "time 10000000.000000 s is not representable: expected a number from -9.2e6 s to 9.2e6 s");
    }
}

TEST(SimTime, AnEventAfterTheLongestRunIsNever) {
    EXPECT_EQ(SimTime::of_event(1.5), SimTime::from_seconds(1.5));
    EXPECT_EQ(SimTime::of_event(SimTime::longest_run_s), SimTime::from_seconds(SimTime::longest_run_s));
    for (const double seconds : {9'200'000.001, 1e7, 1e300}) {
        EXPECT_EQ(SimTime::of_event(seconds), SimTime::never()) << seconds;
    }
    EXPECT_GT(SimTime::never(), SimTime::from_seconds(SimTime::longest_run_s));
}

TEST(SimTime, AnEventForNowIsNotBeforeIt) {
    const SimTime now = SimTime::from_ps(9'021'889'050'000'001);
    ASSERT_LT(SimTime::of_event(now.seconds()), now);
    EXPECT_EQ(SimTime::of_event(now.seconds(), now), now);
    const double before_s = std::nextafter(now.seconds(), 0);
    EXPECT_EQ(SimTime::of_event(before_s, now), SimTime::of_event(before_s));
    const double later_s = now.seconds() + 1e-9;
    EXPECT_EQ(SimTime::of_event(later_s, now), SimTime::of_event(later_s));
}

TEST(SimTime, TheTimeOfAnEventHasToBeANumber) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double seconds : {std::nan(""), infinity, -infinity, -9.3e6}) {
        EXPECT_THROW(SimTime::of_event(seconds), SimulationError) << seconds;
    }
}

TEST(SimTime, Arithmetic) {
    constexpr SimTime a = SimTime::from_us(5);
    constexpr SimTime b = SimTime::from_us(2);
    static_assert(a + b == SimTime::from_us(7));
    static_assert(b - a == SimTime::from_us(-3));
    static_assert(a * 3 == SimTime::from_us(15));
    SimTime sum = a;
    sum += b;
    EXPECT_EQ(sum, SimTime::from_us(7));
}

TEST(SimTime, IsOrdered) {
    static_assert(SimTime::from_us(-1) < SimTime());
    static_assert(SimTime::from_ns(999) < SimTime::from_us(1));
    static_assert(SimTime::max() > SimTime::from_us(1));
}

TEST(SimTime, LongAgoIsFartherThanAnyRun) {
    const SimTime end_of_longest_run = SimTime::from_seconds(2e6);
    EXPECT_GT((end_of_longest_run - SimTime::long_ago()).ps(), end_of_longest_run.ps());
}

}  // namespace
}  // namespace netsim
