#include "netsim/node/timers.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

std::vector<std::uint32_t> cancelled(Timers& timers, const std::string& name) {
    std::vector<std::uint32_t> slots;
    timers.cancel(name, [&slots](EventHandle event) { slots.push_back(event.slot); });
    return slots;
}

TEST(Timers, TakeGivesTheName) {
    Timers timers;
    const std::size_t tick = timers.add("tick");
    const std::size_t tock = timers.add("tock");
    EXPECT_EQ(timers.take(tock), "tock");
    EXPECT_EQ(timers.take(tick), "tick");
}

TEST(Timers, CancelFindsAllEventsOfTheName) {
    Timers timers;
    timers.set_event(timers.add("tick"), {10, 1});
    timers.set_event(timers.add("tock"), {11, 1});
    timers.set_event(timers.add("tick"), {12, 1});
    EXPECT_EQ(cancelled(timers, "tick"), (std::vector<std::uint32_t>{10, 12}));
    EXPECT_TRUE(cancelled(timers, "tick").empty());
    EXPECT_EQ(cancelled(timers, "tock"), std::vector<std::uint32_t>{11});
}

TEST(Timers, CancelLeavesThoseThatWereTaken) {
    Timers timers;
    const std::size_t first = timers.add("tick");
    timers.set_event(first, {10, 1});
    timers.set_event(timers.add("tick"), {11, 1});
    timers.take(first);
    EXPECT_EQ(cancelled(timers, "tick"), std::vector<std::uint32_t>{11});
}

TEST(Timers, NumbersAreUsedAgain) {
    Timers timers;
    const std::size_t first = timers.add("tick");
    timers.take(first);
    EXPECT_EQ(timers.add("tock"), first);
    cancelled(timers, "tock");
    EXPECT_EQ(timers.add("tack"), first);
}

}  // namespace
}  // namespace netsim
