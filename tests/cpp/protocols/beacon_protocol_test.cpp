#include "protocols/beacon_protocol.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"
#include "support/pair_of_nodes.hpp"

namespace netsim {
namespace {

using BeaconProtocolTest = test::PairOfNodes;

TEST_F(BeaconProtocolTest, SendsAtRegularTimesUntilItStops) {
    run("BeaconProtocol", {{"first_send", 2.0}, {"interval", 3.0}, {"stop", 8.0}}, 20);
    ASSERT_EQ(other->packets.size(), 2U);
    EXPECT_GE(other->packets[0].time, SimTime::from_seconds(2));
    EXPECT_LT(other->packets[0].time, SimTime::from_seconds(2.001));
    EXPECT_GE(other->packets[1].time, SimTime::from_seconds(5));
    EXPECT_EQ(tracked("sent"), TrackedValue(std::int64_t{2}));
}

TEST_F(BeaconProtocolTest, ItsMessagesHaveTheirSize) {
    run("BeaconProtocol", {{"payload_bytes", std::int64_t{3}}}, 1.5);
    EXPECT_EQ(other->packet_texts(), std::vector<std::string>{"xxx"});
}

TEST_F(BeaconProtocolTest, ItsOffsetIsTheFirstDrawOfTheNode) {
    run("BeaconProtocol", {{"spread", 1.0}, {"stop", 2.0}}, 3);
    const double offset_s = RandomStream(1, 0, Purpose::protocol).uniform();
    ASSERT_EQ(other->packets.size(), 1U);
    EXPECT_NEAR(other->packets[0].time.seconds(), 1 + offset_s, 0.001);
}

TEST_F(BeaconProtocolTest, CountsWhatItHears) {
    other->on_initialize = [](test::Recorder& self) { self.node.schedule_timer("", SimTime::from_us(1)); };
    other->on_timer = [](test::Recorder& self, const std::string&) { self.broadcast("hello"); };
    run("BeaconProtocol", {}, 0.5);
    EXPECT_EQ(tracked("received"), TrackedValue(std::int64_t{1}));
}

}  // namespace
}  // namespace netsim
