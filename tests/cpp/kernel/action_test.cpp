#include "netsim/kernel/action.hpp"

#include <array>
#include <cstdint>

#include <gtest/gtest.h>

namespace netsim {
namespace {

TEST(Action, CallsWhatItWasGiven) {
    int calls = 0;
    Action action = [&calls] { ++calls; };
    action();
    action();
    EXPECT_EQ(calls, 2);
}

TEST(Action, HoldsThirtyTwoBytesOfCaptures) {
    std::uint64_t sum = 0;
    const std::array<std::uint64_t, 3> numbers{1, 20, 300};
    Action action = [&sum, numbers] { sum = numbers[0] + numbers[1] + numbers[2]; };
    action();
    EXPECT_EQ(sum, 321U);
}

TEST(Action, ACopyKeepsItsOwnState) {
    int seen = 0;
    Action counting = [&seen, count = 0]() mutable { seen = ++count; };
    counting();
    Action copy = counting;
    counting();
    counting();
    EXPECT_EQ(seen, 3);
    copy();
    EXPECT_EQ(seen, 2);
}

TEST(Action, CanBeReplaced) {
    int first = 0;
    int second = 0;
    Action action = [&first] { ++first; };
    action = [&second] { ++second; };
    action();
    EXPECT_EQ(first, 0);
    EXPECT_EQ(second, 1);
}

struct Fetching {
    int* calls;
    int* fetches;

    void operator()() const { ++*calls; }
    void fetch() const { ++*fetches; }
};

TEST(Action, PassesOnThatItWillRunSoon) {
    int calls = 0;
    int fetches = 0;
    const Action action = Fetching{&calls, &fetches};
    action.fetch();
    EXPECT_EQ(fetches, 1);
    EXPECT_EQ(calls, 0);
}

TEST(Action, WhatHasNoFetchNeedNotKnow) {
    int calls = 0;
    int fetches = 0;
    Action action = Fetching{&calls, &fetches};
    action = [&calls] { ++calls; };
    action.fetch();
    EXPECT_EQ(fetches, 0);
    EXPECT_EQ(calls, 0);
}

}  // namespace
}  // namespace netsim
