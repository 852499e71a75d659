#include "protocols/heartbeat_clock.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

TEST(HeartbeatClock, TheFirstIsTheFirstAfterTheStart) {
    RandomStream random(1, 0, Purpose::protocol);
    HeartbeatClock clock(2, 0, 5, random);
    EXPECT_EQ(clock.next(), SimTime::from_seconds(6));
    EXPECT_EQ(clock.next(), SimTime::from_seconds(8));
}

TEST(HeartbeatClock, EachHasADelayOfItsOwn) {
    RandomStream random(1, 0, Purpose::protocol);
    RandomStream same(1, 0, Purpose::protocol);
    HeartbeatClock clock(1, 0.1, 0, random);
    EXPECT_EQ(clock.next(), SimTime::from_seconds(1 + same.uniform(0, 0.1)));
    EXPECT_EQ(clock.next(), SimTime::from_seconds(2 + same.uniform(0, 0.1)));
}

}  // namespace
}  // namespace netsim
