#include "netsim/kernel/action.hpp"

#include <array>
#include <cstdint>
#include <vector>

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

struct Prefetching {
    int* calls;
    std::vector<int>* steps;

    void operator()() const { ++*calls; }
    void prefetch(int step) const { steps->push_back(step); }
};

TEST(Action, PassesOnThatItWillRunSoon) {
    int calls = 0;
    std::vector<int> steps;
    const Action action = Prefetching{&calls, &steps};
    action.prefetch(0);
    action.prefetch(1);
    EXPECT_EQ(steps, (std::vector{0, 1}));
    EXPECT_EQ(calls, 0);
}

TEST(Action, WhatHasNoPrefetchNeedNotKnow) {
    int calls = 0;
    std::vector<int> steps;
    Action action = Prefetching{&calls, &steps};
    action = [&calls] { ++calls; };
    action.prefetch(0);
    EXPECT_TRUE(steps.empty());
    EXPECT_EQ(calls, 0);
}

}  // namespace
}  // namespace netsim
