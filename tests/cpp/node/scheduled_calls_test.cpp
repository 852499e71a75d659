#include "netsim/node/scheduled_calls.hpp"

#include <memory>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

SimTime seconds(double value) {
    return SimTime::from_seconds(value);
}

struct ScheduledCallsTest : testing::Test {
    Simulator simulator;
    ScheduledCalls calls{simulator};
    std::vector<int> ran;

    void note(double time, int number) {
        calls.add(seconds(time), [this, number] { ran.push_back(number); });
    }
};

TEST_F(ScheduledCallsTest, RunInTheOrderOfTheirTimes) {
    note(2, 2);
    note(1, 1);
    note(2, 3);
    simulator.run_until(seconds(3));
    EXPECT_EQ(ran, (std::vector{1, 2, 3}));
}

TEST_F(ScheduledCallsTest, ACallMaySchedule) {
    calls.add(seconds(1), [this] { note(2, 7); });
    simulator.run_until(seconds(3));
    EXPECT_EQ(ran, (std::vector{7}));
}

TEST_F(ScheduledCallsTest, WhatACallOwnsIsLetGoOfWhenItHasRun) {
    const auto owned = std::make_shared<int>();
    calls.add(seconds(1), [owned] {});
    simulator.run_until(seconds(3));
    EXPECT_EQ(owned.use_count(), 1);
}

TEST_F(ScheduledCallsTest, WhatItThrowsPassesThroughAndTheOthersRunLater) {
    const auto owned = std::make_shared<int>();
    calls.add(seconds(1), [owned] { throw std::runtime_error("no way out"); });
    note(2, 1);
    EXPECT_THROW(simulator.run_until(seconds(3)), std::runtime_error);
    EXPECT_EQ(owned.use_count(), 1);
    simulator.run_until(seconds(3));
    EXPECT_EQ(ran, (std::vector{1}));
}

TEST_F(ScheduledCallsTest, DroppedOnesDoNotRunAndOwnNothing) {
    const auto owned = std::make_shared<int>();
    calls.add(seconds(1), [this, owned] { ran.push_back(*owned); });
    calls.drop();
    EXPECT_EQ(owned.use_count(), 1);
    EXPECT_EQ(simulator.pending_count(), 0U);
    note(1, 5);
    simulator.run_until(seconds(3));
    EXPECT_EQ(ran, (std::vector{5}));
}

TEST_F(ScheduledCallsTest, ACallMayDropThemAllItselfToo) {
    note(2, 1);
    calls.add(seconds(1), [this] {
        calls.drop();
        ran.push_back(9);
    });
    simulator.run_until(seconds(3));
    EXPECT_EQ(ran, (std::vector{9}));
}

TEST_F(ScheduledCallsTest, TheEndOfADroppedOneMaySchedule) {
    struct Guard {
        ScheduledCallsTest* test;
        ~Guard() { test->note(1, 4); }
    };
    calls.add(seconds(1), [guard = std::make_shared<Guard>(this)] {});
    calls.drop();
    simulator.run_until(seconds(3));
    EXPECT_EQ(ran, (std::vector{4}));
}

}  // namespace
}  // namespace netsim
