#include "netsim/mac/retry.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr Retry::Rules usual{{.short_failures = 7, .long_failures = 4}, {.min = 15, .max = 100}};
constexpr Retry::Rules two_failures{{.short_failures = 2, .long_failures = 2}, {.min = 15, .max = 100}};
constexpr Retry::Rules window_of_station{two_failures.limits, two_failures.window,
                                         Retry::Rule::station_window};
constexpr Retry::Rules two_of_station{two_failures.limits, two_failures.window,
                                      Retry::Rule::station_counters};

TEST(Retry, TheSeventhShortFailureIsTheLast) {
    Retry retry(usual);
    for (int failure = 1; failure < 7; ++failure) {
        EXPECT_TRUE(retry.short_failed()) << failure;
    }
    EXPECT_FALSE(retry.short_failed());
}

TEST(Retry, TheFourthLongFailureIsTheLast) {
    Retry retry(usual);
    for (int failure = 1; failure < 4; ++failure) {
        EXPECT_TRUE(retry.long_failed()) << failure;
    }
    EXPECT_FALSE(retry.long_failed());
}

TEST(Retry, TheCountersDoNotAddUp) {
    Retry retry(usual);
    for (int failure = 1; failure < 7; ++failure) {
        EXPECT_TRUE(retry.short_failed()) << failure;
    }
    for (int failure = 1; failure < 4; ++failure) {
        EXPECT_TRUE(retry.long_failed()) << failure;
    }
}

TEST(Retry, EveryFailureDoublesTheWindowUpToItsMaximum) {
    Retry retry(usual);
    std::vector<int> windows{retry.contention_window()};
    retry.short_failed();
    windows.push_back(retry.contention_window());
    retry.long_failed();
    windows.push_back(retry.contention_window());
    retry.short_failed();
    windows.push_back(retry.contention_window());
    EXPECT_EQ(windows, (std::vector{15, 31, 63, 100}));
}

TEST(Retry, AfterAnAckAFrameHasTheSmallestWindowAndAllAttempts) {
    Retry retry(two_failures);
    retry.short_failed();
    retry.long_failed();
    retry.acknowledged(true);
    EXPECT_EQ(retry.contention_window(), 15);
    EXPECT_TRUE(retry.short_failed());
    EXPECT_TRUE(retry.long_failed());
}

TEST(Retry, AfterAFrameThatWasGivenUpTheNextHasTheSmallestWindowAndAllAttempts) {
    Retry retry(two_failures);
    retry.long_failed();
    retry.short_failed();
    EXPECT_FALSE(retry.short_failed());
    retry.given_up();
    EXPECT_EQ(retry.contention_window(), 15);
    EXPECT_TRUE(retry.short_failed());
    EXPECT_TRUE(retry.long_failed());
}

// Station counters: two failures each, windows of 15, 31, 63 …
class RetryOfStation : public testing::Test {
protected:
    static std::vector<int> windows_after_short_failures(Retry& retry, int count) {
        std::vector<int> windows;
        for (int failure = 0; failure < count; ++failure) {
            if (!retry.short_failed()) {
                retry.given_up();
            }
            windows.push_back(retry.contention_window());
        }
        return windows;
    }

    Retry retry_{two_of_station};
};

TEST_F(RetryOfStation, TheWindowIsSmallAfterTheFirstFrameGivenUpAndGrowsFromThereOn) {
    EXPECT_EQ(windows_after_short_failures(retry_, 6), (std::vector{31, 15, 31, 63, 100, 100}));
}

TEST_F(RetryOfStation, EachFrameHasAllAttempts) {
    EXPECT_TRUE(retry_.short_failed());
    EXPECT_FALSE(retry_.short_failed());
    retry_.given_up();
    EXPECT_TRUE(retry_.short_failed());
    EXPECT_FALSE(retry_.short_failed());
}

TEST_F(RetryOfStation, AnAckEndsTheRow) {
    windows_after_short_failures(retry_, 4);
    retry_.acknowledged(false);
    EXPECT_EQ(retry_.contention_window(), 15);
    EXPECT_EQ(windows_after_short_failures(retry_, 3), (std::vector{31, 15, 31}));
}

TEST_F(RetryOfStation, AnAckOfALongFrameDoesNotEndTheRowOfShortOnes) {
    windows_after_short_failures(retry_, 1);
    retry_.acknowledged(true);
    EXPECT_EQ(windows_after_short_failures(retry_, 2), (std::vector{15, 31}));
}

TEST_F(RetryOfStation, ACtsEndsTheRowOfShortFailuresAndLeavesTheWindow) {
    windows_after_short_failures(retry_, 3);
    retry_.rts_answered();
    EXPECT_EQ(retry_.contention_window(), 31);
    EXPECT_EQ(windows_after_short_failures(retry_, 2), (std::vector{63, 15}));
}

TEST_F(RetryOfStation, ABroadcastEndsTheRowAndLeavesTheWindow) {
    windows_after_short_failures(retry_, 4);
    retry_.broadcast_sent();
    EXPECT_EQ(retry_.contention_window(), 63);
    EXPECT_EQ(windows_after_short_failures(retry_, 2), (std::vector{100, 15}));
}

// The window of ns-3: two failures for each frame, and the third in a row resets the window.
class WindowOfStation : public RetryOfStation {
protected:
    Retry retry_{window_of_station};
};

TEST_F(WindowOfStation, AFrameGivenUpLeavesIt) {
    EXPECT_EQ(windows_after_short_failures(retry_, 2), (std::vector{31, 63}));
}

TEST_F(WindowOfStation, EveryThirdFailureResetsIt) {
    EXPECT_EQ(windows_after_short_failures(retry_, 7), (std::vector{31, 63, 15, 31, 63, 15, 31}));
}

TEST_F(WindowOfStation, AnAckResetsItAndEndsTheRow) {
    windows_after_short_failures(retry_, 2);
    retry_.acknowledged(false);
    EXPECT_EQ(retry_.contention_window(), 15);
    EXPECT_EQ(windows_after_short_failures(retry_, 3), (std::vector{31, 63, 15}));
}

}  // namespace
}  // namespace netsim
