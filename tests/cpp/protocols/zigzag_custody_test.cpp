#include "protocols/zigzag_custody.hpp"

#include <gtest/gtest.h>

namespace netsim::zigzag {
namespace {

TEST(Custody, WhatIsGivenIsNotHeldAnyMore) {
    Custody custody;
    custody.add_reading();
    custody.add_reading();
    custody.give_all(5);
    EXPECT_EQ(custody.held(), 0);
    EXPECT_EQ(custody.given_to(5), 2);
    EXPECT_EQ(custody.given_to(6), 0);
}

TEST(Custody, OnlyWhatIsNewIsTaken) {
    Custody custody;
    EXPECT_EQ(custody.take(5, 3), 3);
    EXPECT_EQ(custody.take(5, 3), 0);
    EXPECT_EQ(custody.take(5, 4), 1);
    EXPECT_EQ(custody.take(6, 1), 1);
    EXPECT_EQ(custody.held(), 5);
}

TEST(Custody, AnOldMessageTakesNothingAway) {
    Custody custody;
    custody.take(5, 3);
    EXPECT_EQ(custody.take(5, 1), 0);
    EXPECT_EQ(custody.held(), 3);
}

}  // namespace
}  // namespace netsim::zigzag
