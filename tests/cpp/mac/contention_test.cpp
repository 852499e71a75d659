// Waiting for the channel. EIFS is in contention_eifs_test.cpp.
#include "netsim/mac/contention.hpp"

#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "support/contention_fixture.hpp"

namespace netsim {
namespace {

using test::ContentionTest;
using test::difs;
using test::GrantLog;
using test::slot;
using test::us;

TEST_F(ContentionTest, WithoutABackoffOnAFreeChannelADifsFromTheStartIsWaited) {
    contention();
    simulator.schedule_at(us(5000), [this] { contention().start_without_backoff_if_free(1023); });
    run();
    EXPECT_EQ(grants, std::vector{us(5050)});
}

TEST_F(ContentionTest, WithoutABackoffADifsIsWaitedAgainAfterABusyChannel) {
    contention();
    simulator.schedule_at(us(5000), [this] { contention().start_without_backoff_if_free(1023); });
    busy_at(us(5020), us(300));
    run();
    EXPECT_EQ(grants, std::vector{us(5370)});
}

TEST_F(ContentionTest, OnABusyChannelABackoffIsDrawnAllTheSame) {
    contention();
    busy_at(us(4900), us(300));
    simulator.schedule_at(us(5000), [this] { contention().start_without_backoff_if_free(1023); });
    run();
    EXPECT_GT(grants.front(), us(5250));
}

TEST_F(ContentionTest, GrantsAtOnceOnAChannelThatWasIdleForLong) {
    contention();
    start_at(us(5000), 31);
    run();
    EXPECT_EQ(grants, std::vector{us(5000)});
}

TEST_F(ContentionTest, IsInProgressUntilTheGrant) {
    busy_at(us(0), us(100));
    start_at(us(10));
    simulator.run_until(us(149));
    EXPECT_TRUE(contention().in_progress());
    simulator.run_until(us(150));
    EXPECT_FALSE(contention().in_progress());
}

TEST_F(ContentionTest, WithoutImmediateAccessItWaitsDifs) {
    contention(false);
    start_at(us(5000));
    run();
    EXPECT_EQ(grants, std::vector{us(5000) + difs});
}

TEST_F(ContentionTest, IdleTimeBeforeTheStartCounts) {
    busy_at(us(900), us(100));
    start_at(us(1030));
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + difs});
}

TEST_F(ContentionTest, OfIdleTimeOnlyThatSinceTheLastGrantCounts) {
    contention();
    start_at(us(1000));
    start_at(us(1010));
    run();
    EXPECT_EQ(grants, (std::vector{us(1000), us(1000) + difs}));
}

TEST_F(ContentionTest, DefersToABusyChannel) {
    busy_at(us(0), us(1000));
    start_at(us(500));
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + difs});
}

TEST_F(ContentionTest, BusyTimeDuringTheSpaceStartsItAgain) {
    busy_at(us(0), us(1000));
    start_at(us(500));
    busy_at(us(1049), us(100));
    run();
    EXPECT_EQ(grants, std::vector{us(1149) + difs});
}

TEST_F(ContentionTest, WhatBeginsInTheInstantOfAGrantCannotHoldItBack) {
    busy_at(us(0), us(1000));
    start_at(us(500));
    busy_at(us(1050), us(100));
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + difs});
}

TEST_F(ContentionTest, NorWhatBeginsAtMostANanosecondBefore) {
    busy_at(us(0), us(1000));
    start_at(us(500));
    busy_at(us(1050) - SimTime::from_ns(1), us(100));
    run();
    EXPECT_EQ(grants, std::vector{us(1000) + difs});
}

TEST_F(ContentionTest, WhatBeginsEarlierHoldsTheGrantBack) {
    busy_at(us(0), us(1000));
    start_at(us(500));
    const SimTime begin = us(1050) - SimTime::from_ps(1001);
    busy_at(begin, us(100));
    run();
    EXPECT_EQ(grants, std::vector{begin + us(100) + difs});
}

TEST_F(ContentionTest, AGrantIsTheLastEventOfItsInstant) {
    std::vector<SimTime> grants_before;
    busy_at(us(0), us(1000));
    start_at(us(500));
    simulator.schedule_at(us(1049), [this, &grants_before] {
        simulator.schedule_at(us(1050), [this, &grants_before] { grants_before = grants; });
    });
    run();
    EXPECT_EQ(grants_before, std::vector<SimTime>{});
    EXPECT_EQ(grants, std::vector{us(1000) + difs});
}

TEST_F(ContentionTest, AtTheStartOfARunTheChannelWasBusyUntilThen) {
    contention();
    start_at(us(20));
    run();
    EXPECT_EQ(grants, std::vector{difs});
}

TEST_F(ContentionTest, IfItWasNotBusyInitiallyAFrameLeavesAtOnce) {
    MacConfig config;
    config.initial_channel_busy = false;
    contention(config);
    start_at(us(20), 1023);
    run();
    EXPECT_EQ(grants, std::vector{us(20)});
}

TEST_F(ContentionTest, ABackoffIsAWholeNumberOfSlotsFromZeroToTheWindow) {
    std::set<std::int64_t> slots;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        Simulator own;
        const DcfParameters parameters(own, MacConfig());
        GrantLog log(own);
        Contention own_contention(parameters, RandomStream(seed, 0, Purpose::backoff), log);
        own_contention.start(15);
        own.run_until(us(10'000));
        const SimTime backoff = log.times.at(0) - difs;
        ASSERT_EQ(backoff.ps() % slot.ps(), 0);
        slots.insert(backoff.ps() / slot.ps());
    }
    EXPECT_EQ(slots.size(), 16U);
    EXPECT_EQ(*slots.begin(), 0);
    EXPECT_EQ(*slots.rbegin(), 15);
}

// A contention with a known number of slots, because it is the same as in a run without
// disturbance.
class RemainingSlots : public ContentionTest {
protected:
    static constexpr std::uint64_t seed = 4;
    static constexpr int window = 31;

    void SetUp() override {
        slots = static_cast<std::int64_t>(RandomStream(seed, 0, Purpose::backoff).uniform_int(window + 1));
        ASSERT_GE(slots, 5);
        contention(false, seed);
        start_at(us(0), window);
    }
    std::int64_t slots = 0;
};

TEST_F(RemainingSlots, AreAllWaitedForOnAFreeChannel) {
    run();
    EXPECT_EQ(grants, std::vector{difs + slot * slots});
}

TEST_F(RemainingSlots, AreKeptOverABusyChannel) {
    const SimTime after_three_slots = difs + slot * 3;
    busy_at(after_three_slots, us(1000));
    run();
    EXPECT_EQ(grants, std::vector{after_three_slots + us(1000) + difs + slot * (slots - 3)});
}

TEST_F(RemainingSlots, ASlotThatHasOnlyBegunIsWaitedForAgain) {
    const SimTime within_the_fourth_slot = difs + slot * 3 + us(19);
    busy_at(within_the_fourth_slot, us(1000));
    run();
    EXPECT_EQ(grants, std::vector{within_the_fourth_slot + us(1000) + difs + slot * (slots - 3)});
}

TEST_F(RemainingSlots, TheSpaceIsNoSlots) {
    busy_at(us(1), us(1000));
    busy_at(us(1001 + 49), us(1000));
    run();
    EXPECT_EQ(grants, std::vector{us(2050) + difs + slot * slots});
}

TEST_F(RemainingSlots, AreKeptThroughManyInterruptions) {
    SimTime free;
    for (int i = 1; i <= 4; ++i) {  // a slot between any two
        const SimTime busy = free + difs + slot;
        busy_at(busy, us(100));
        free = busy + us(100);
    }
    run();
    EXPECT_EQ(grants, std::vector{free + difs + slot * (slots - 4)});
}

using ContentionDeathTest = ContentionTest;

TEST_F(ContentionDeathTest, StartingTwiceIsAnInternalError) {
    contention().channel_busy_changed(true);
    contention().start(0);
    EXPECT_DEATH(contention().start(0), "internal error");
}

}  // namespace
}  // namespace netsim
