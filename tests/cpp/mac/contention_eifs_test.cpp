// EIFS by the rules of the standard and of INET.
#include <vector>

#include <gtest/gtest.h>

#include "support/contention_fixture.hpp"

namespace netsim {
namespace {

using test::ContentionTest;
using test::difs;
using test::eifs;
using test::us;

TEST_F(ContentionTest, ABrokenFrameIsFollowedByEifs) {
    busy_at(us(0), us(1000));
    start_at(us(500));
    corrupted_at(us(999));
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + eifs});
}

TEST_F(ContentionTest, EifsCountsTowardsImmediateAccessAsDifsDoes) {
    busy_at(us(0), us(1000));
    corrupted_at(us(999));
    start_at(us(1010));
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + eifs});
}

TEST_F(ContentionTest, EifsBeginsWhenTheChannelIsFreeHoweverLongThatTakes) {
    busy_at(us(0), us(1000));
    start_at(us(500));
    corrupted_at(us(100));
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + eifs});
}

TEST_F(ContentionTest, EifsBeginsWhenTheRadioFindsItFreeWhateverKeepsTheStationSilent) {
    contention();
    corrupted_at(us(100));
    simulator.schedule_at(us(0), [this] { contention().channel_busy_changed(true); });
    simulator.schedule_at(us(200), [this] { contention().radio_finds_it_free(); });
    simulator.schedule_at(us(1000),
                          [this] { contention().channel_busy_changed(false); });  // the end of a NAV
    start_at(us(500));
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + difs});
}

TEST_F(ContentionTest, AGoodFrameAfterTheBrokenOneBringsBackDifs) {
    busy_at(us(0), us(1000));
    start_at(us(500));
    corrupted_at(us(600));
    received_at(us(999));
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + difs});
}

TEST_F(ContentionTest, AGoodFrameEndsAnEifsUnderWay) {
    busy_at(us(0), us(1000));
    corrupted_at(us(999));
    start_at(us(1010));
    busy_at(us(1100), us(100));
    received_at(us(1199));
    run();
    EXPECT_EQ(grants, std::vector{us(1200) + difs});
}

TEST_F(ContentionTest, NoiseDuringEifsDoesNotBeginItAnew) {
    busy_at(us(0), us(1000));
    corrupted_at(us(999));
    start_at(us(1010));
    busy_at(us(1100), us(100));
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + eifs});
}

TEST_F(ContentionTest, DifsOutlastsTheRestOfAnEifs) {
    busy_at(us(0), us(1000));
    corrupted_at(us(999));
    start_at(us(1010));
    busy_at(us(1100), us(250));
    run();
    EXPECT_EQ(grants, std::vector{us(1350) + difs});
}

class InetEifsTest : public ContentionTest {
protected:
    InetEifsTest() {
        MacConfig config;
        config.inet_eifs = true;
        contention(config);
    }
};

TEST_F(InetEifsTest, BeginsWithTheEndOfTheBrokenFrameAndIsWaitedWholeWhenTheChannelIsFree) {
    busy_at(us(0), us(1000));
    start_at(us(500));
    corrupted_at(us(900));
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + eifs});
}

TEST_F(InetEifsTest, IsOverIfTheChannelIsBusyForSoLongThatDifsOutlastsIt) {
    busy_at(us(0), us(1000));
    start_at(us(500));
    corrupted_at(us(1000) + difs - eifs);
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + difs});
}

TEST_F(InetEifsTest, IsOfNoConcernToAStationThatDoesNotWaitForTheChannel) {
    busy_at(us(0), us(1000));
    corrupted_at(us(999));
    start_at(us(1010));
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + difs});
}

TEST_F(InetEifsTest, AGoodFrameDoesNotEndIt) {
    busy_at(us(0), us(1000));
    start_at(us(500));
    corrupted_at(us(900));
    received_at(us(999));
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + eifs});
}

TEST_F(InetEifsTest, WhatEndsWithinItIsFollowedByAWholeOne) {
    busy_at(us(0), us(1000));
    start_at(us(500));
    corrupted_at(us(999));
    busy_at(us(1100), us(100));
    run();
    EXPECT_EQ(grants, std::vector{us(1200) + eifs});
}

class Ns3EifsTest : public ContentionTest {
protected:
    Ns3EifsTest() {
        MacConfig config;
        config.ns3_eifs = true;
        contention(config);
    }
};

TEST_F(Ns3EifsTest, BeginsWithTheEndOfTheBrokenFrame) {
    busy_at(us(0), us(1000));
    start_at(us(500));
    corrupted_at(us(900));
    run();
    EXPECT_EQ(grants, std::vector{us(900) + eifs});
}

TEST_F(Ns3EifsTest, IsOverIfTheChannelIsBusyForLonger) {
    busy_at(us(0), us(1000));
    start_at(us(500));
    corrupted_at(us(100));
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + difs});
}

TEST_F(Ns3EifsTest, AGoodFrameEndsIt) {
    busy_at(us(0), us(1000));
    start_at(us(500));
    corrupted_at(us(900));
    received_at(us(999));
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + difs});
}

}  // namespace
}  // namespace netsim
