#include "netsim/kernel/simulator.hpp"

#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr SimTime us(std::int64_t microseconds) {
    return SimTime::from_us(microseconds);
}

TEST(Simulator, TheClockStandsAtTheEventThatRuns) {
    Simulator simulator;
    SimTime seen;
    simulator.schedule_at(us(5), [&] { seen = simulator.now(); });
    simulator.run_until(us(10));
    EXPECT_EQ(seen, us(5));
}

TEST(Simulator, RunUntilSetsTheClockToItsLimit) {
    Simulator simulator;
    EXPECT_TRUE(simulator.run_until(us(10)));
    EXPECT_EQ(simulator.now(), us(10));
}

TEST(Simulator, TheLimitIsInclusive) {
    Simulator simulator;
    std::vector<int> ran;
    simulator.schedule_at(us(10), [&] { ran.push_back(10); });
    simulator.schedule_at(us(10) + SimTime::from_ps(1), [&] { ran.push_back(11); });
    simulator.run_until(us(10));
    EXPECT_EQ(ran, std::vector{10});
    EXPECT_EQ(simulator.pending_count(), 1U);
}

TEST(Simulator, ALimitInThePastLeavesTheClock) {
    Simulator simulator;
    simulator.run_until(us(10));
    EXPECT_TRUE(simulator.run_until(us(3)));
    EXPECT_EQ(simulator.now(), us(10));
}

TEST(Simulator, ScheduleAfterCountsFromNow) {
    Simulator simulator;
    SimTime seen;
    simulator.schedule_at(us(5), [&] { simulator.schedule_after(us(2), [&] { seen = simulator.now(); }); });
    simulator.run_until(us(10));
    EXPECT_EQ(seen, us(7));
}

TEST(Simulator, AnEventOfThePresentInstantRunsInIt) {
    Simulator simulator;
    int runs = 0;
    simulator.schedule_at(us(5), [&] { simulator.schedule_after(SimTime(), [&] { ++runs; }); });
    simulator.run_until(us(5));
    EXPECT_EQ(runs, 1);
}

TEST(Simulator, LastRunsAfterWhatItsInstantBringsForth) {
    Simulator simulator;
    std::vector<int> ran;
    simulator.schedule_at(us(5), [&] { ran.push_back(3); }, Priority::last);
    simulator.schedule_at(us(5), [&] {
        ran.push_back(1);
        simulator.schedule_after(SimTime(), [&] { ran.push_back(2); });
    });
    simulator.run_until(us(5));
    EXPECT_EQ(ran, (std::vector{1, 2, 3}));
}

TEST(Simulator, MaxEventsStopsAtTheLastEventThatRan) {
    Simulator simulator;
    for (int time = 1; time <= 3; ++time) {
        simulator.schedule_at(us(time), [] {});
    }
    EXPECT_FALSE(simulator.run_until(us(10), 2));
    EXPECT_EQ(simulator.now(), us(2));
    EXPECT_EQ(simulator.event_count(), 2U);
    EXPECT_TRUE(simulator.run_until(us(10), 2));
    EXPECT_EQ(simulator.now(), us(10));
}

TEST(Simulator, MaxEventsThatAreJustEnoughReachTheLimit) {
    Simulator simulator;
    simulator.schedule_at(us(1), [] {});
    simulator.schedule_at(us(20), [] {});
    EXPECT_TRUE(simulator.run_until(us(10), 1));
    EXPECT_EQ(simulator.now(), us(10));
}

TEST(Simulator, CancelledEventsDoNotCount) {
    Simulator simulator;
    const EventHandle handle = simulator.schedule_at(us(1), [] {});
    EXPECT_TRUE(simulator.is_pending(handle));
    EXPECT_TRUE(simulator.cancel(handle));
    simulator.run_until(us(10));
    EXPECT_EQ(simulator.event_count(), 0U);
}

TEST(Simulator, AnEventIsNotPendingWhileItRuns) {
    Simulator simulator;
    EventHandle handle;
    bool pending = true;
    handle = simulator.schedule_at(us(1), [&] { pending = simulator.is_pending(handle); });
    simulator.run_until(us(1));
    EXPECT_FALSE(pending);
}

TEST(Simulator, AnExceptionLeavesItUsable) {
    Simulator simulator;
    int runs = 0;
    simulator.schedule_at(us(1), [] { throw std::runtime_error("of the protocol"); });
    simulator.schedule_at(us(2), [&] { ++runs; });
    EXPECT_THROW(simulator.run_until(us(10)), std::runtime_error);
    EXPECT_EQ(simulator.now(), us(1));
    EXPECT_EQ(simulator.pending_count(), 1U);
    EXPECT_TRUE(simulator.run_until(us(10)));
    EXPECT_EQ(runs, 1);
}

TEST(Simulator, AStepIsOneEventAndTheClockStandsAtIt) {
    Simulator simulator;
    int runs = 0;
    simulator.schedule_at(us(1), [&] { ++runs; });
    simulator.schedule_at(us(2), [&] { ++runs; });
    EXPECT_TRUE(simulator.step(us(10)));
    EXPECT_EQ(runs, 1);
    EXPECT_EQ(simulator.now(), us(1));
    EXPECT_EQ(simulator.event_count(), 1U);
}

TEST(Simulator, WithoutAnEventUpToTheLimitThereIsNoStep) {
    Simulator simulator;
    EXPECT_FALSE(simulator.step(us(10)));
    simulator.schedule_at(us(2), [] {});
    EXPECT_FALSE(simulator.step(us(1)));
    EXPECT_EQ(simulator.now(), SimTime{});
    EXPECT_TRUE(simulator.step(us(2)));
    EXPECT_FALSE(simulator.step(us(10)));
    EXPECT_EQ(simulator.now(), us(2));
}

TEST(SimulatorDeathTest, SchedulingInThePastIsAnInternalError) {
    Simulator simulator;
    simulator.run_until(us(10));
    EXPECT_DEATH(simulator.schedule_at(us(9), [] {}), "internal error: time >= now_ does not hold");
}

}  // namespace
}  // namespace netsim
