#include "netsim/mac/retry.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

Retry usual() {
    return Retry({.short_failures = 7, .long_failures = 4}, {.min = 15, .max = 100});
}

TEST(Retry, TheSeventhShortFailureIsTheLast) {
    Retry retry = usual();
    for (int failure = 1; failure < 7; ++failure) {
        EXPECT_TRUE(retry.short_failed()) << failure;
    }
    EXPECT_FALSE(retry.short_failed());
}

TEST(Retry, TheFourthLongFailureIsTheLast) {
    Retry retry = usual();
    for (int failure = 1; failure < 4; ++failure) {
        EXPECT_TRUE(retry.long_failed()) << failure;
    }
    EXPECT_FALSE(retry.long_failed());
}

TEST(Retry, TheCountersDoNotAddUp) {
    Retry retry = usual();
    for (int failure = 1; failure < 7; ++failure) {
        EXPECT_TRUE(retry.short_failed()) << failure;
    }
    for (int failure = 1; failure < 4; ++failure) {
        EXPECT_TRUE(retry.long_failed()) << failure;
    }
}

TEST(Retry, EveryFailureDoublesTheWindowUpToItsMaximum) {
    Retry retry = usual();
    std::vector<int> windows{retry.contention_window()};
    retry.short_failed();
    windows.push_back(retry.contention_window());
    retry.long_failed();
    windows.push_back(retry.contention_window());
    retry.short_failed();
    windows.push_back(retry.contention_window());
    EXPECT_EQ(windows, (std::vector{15, 31, 63, 100}));
}

TEST(Retry, ANewStartHasTheSmallestWindowAndAllAttempts) {
    Retry retry({.short_failures = 2, .long_failures = 2}, {.min = 15, .max = 100});
    retry.short_failed();
    retry.long_failed();
    retry.start_afresh();
    EXPECT_EQ(retry.contention_window(), 15);
    EXPECT_TRUE(retry.short_failed());
    EXPECT_TRUE(retry.long_failed());
}

}  // namespace
}  // namespace netsim
