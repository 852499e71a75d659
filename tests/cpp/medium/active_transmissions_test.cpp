#include "netsim/medium/active_transmissions.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "netsim/medium/arrival.hpp"

namespace netsim {
namespace {

SimTime us(std::int64_t microseconds) {
    return SimTime::from_us(microseconds);
}

class ActiveTransmissionsTest : public testing::Test {
protected:
    ActiveTransmissionsTest() {
        links.add(InterfaceId{0, 0}, {.trajectory = &place, .parameters = {.band = band}}, MountedAntenna(),
                  SimTime());
        links.add(InterfaceId{1, 0}, {.trajectory = &elsewhere, .parameters = {.band = band}},
                  MountedAntenna(), SimTime());
    }
    ActiveTransmission& put(SimTime start, SimTime last_end) {
        Transmission transmission;
        transmission.band = band;
        transmission.power_w = 1e-3;
        ActiveTransmission& entry = waves.put(std::move(transmission), start, 0);
        entry.last_end = last_end;
        return entry;
    }

    const Band band{2.412e9, 20e6};
    Trajectory place{{1, 2, 3}};
    Trajectory elsewhere{{301, 2, 3}};
    Links links{MediumConfig(), 1};
    ActiveTransmissions waves{links};
};

TEST_F(ActiveTransmissionsTest, NumbersTransmissionsInTheOrderOfTheirStarts) {
    put(us(10), us(20));
    const ActiveTransmission& second = put(us(15), us(30));
    EXPECT_EQ(second.transmission.id(), 1U);
    EXPECT_EQ(second.transmission.start, us(15));
    EXPECT_EQ(second.transmission.origin, (Position{1, 2, 3}));
    EXPECT_EQ(&waves.of_id(1), &second);
    EXPECT_EQ(waves.next_id(), 2U);
}

TEST_F(ActiveTransmissionsTest, ConcurrentOnesBeganBeforeAndLastLonger) {
    put(us(10), us(20));
    ActiveTransmission& second = put(us(15), us(30));
    const ActiveTransmission& third = put(us(20), us(40));
    std::vector<ActiveTransmission*> concurrent;
    waves.find_concurrent(third, concurrent);
    EXPECT_EQ(concurrent, std::vector{&second});
}

TEST_F(ActiveTransmissionsTest, KeepsEndedOnesWhileAnEarlierOneIsOnTheAir) {
    put(us(10), us(100));
    put(us(20), us(30));
    waves.forget_ended(us(90), us(0));
    EXPECT_EQ(waves.size(), 2U);
    waves.forget_ended(us(101), us(0));
    EXPECT_TRUE(waves.empty());
}

TEST_F(ActiveTransmissionsTest, KeepsEndedOnesForTheRequestedTime) {
    put(us(10), us(20));
    waves.forget_ended(us(50), us(30));
    EXPECT_EQ(waves.size(), 1U);
    waves.forget_ended(us(51), us(30));
    EXPECT_TRUE(waves.empty());
}

TEST_F(ActiveTransmissionsTest, UsesTheGivenPlaceIfNoNodeMoved) {
    const ActiveTransmission& sent = put(us(10), us(200));
    const Arrival looked_up = waves.arrival_at(sent, 1);
    const Arrival given = waves.arrival_at(sent, 1, {301, 2, 3}, us(50));
    EXPECT_EQ(given.start, looked_up.start);
    EXPECT_EQ(given.power_w, looked_up.power_w);
}

TEST_F(ActiveTransmissionsTest, UsesThePlaceAtTheStartOnceANodeMoved) {
    const ActiveTransmission& sent = put(us(10), us(200));
    elsewhere.go_to(us(20), {1001, 2, 3}, 1000);
    const Arrival arrival = waves.arrival_at(sent, 1, {900, 2, 3}, us(50));
    EXPECT_EQ(arrival.place, (Position{301, 2, 3}));
}

}  // namespace
}  // namespace netsim
