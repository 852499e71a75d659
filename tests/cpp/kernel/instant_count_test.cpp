#include "netsim/kernel/instant_count.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

// The first call that reports an excess, of many at one instant.
std::int32_t first_too_many(InstantCount& count, SimTime instant) {
    std::int32_t number = 1;
    while (!count.exceeds(instant)) {
        ++number;
    }
    return number;
}

TEST(InstantCount, IsExceededByTheFirstAboveTheBound) {
    InstantCount count;
    EXPECT_EQ(first_too_many(count, SimTime()), max_per_instant + 1);
    EXPECT_TRUE(count.exceeds(SimTime()));
}

TEST(InstantCount, BeginsAnewAtEachInstant) {
    InstantCount count;
    first_too_many(count, SimTime());
    EXPECT_EQ(first_too_many(count, SimTime::from_ps(1)), max_per_instant + 1);
}

}  // namespace
}  // namespace netsim
