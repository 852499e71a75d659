#include "protocols/saturating_source.hpp"

#include <cstdint>

#include <gtest/gtest.h>

#include "config/error_text.hpp"
#include "support/pair_of_nodes.hpp"

namespace netsim {
namespace {

using SaturatingSourceTest = test::PairOfNodes;

TEST_F(SaturatingSourceTest, HandsOverABurstInEachInterval) {
    run("SaturatingSource",
        {{"destination", std::int64_t{1}},
         {"burst", std::int64_t{3}},
         {"interval", 0.1},
         {"payload_bytes", std::int64_t{10}}},
        0.25);
    EXPECT_EQ(other->packets.size(), 9U);
    EXPECT_EQ(other->packets.back().text, "xxxxxxxxxx");
}

TEST_F(SaturatingSourceTest, BeginsWithinTheSpread) {
    run("SaturatingSource",
        {{"destination", std::int64_t{1}}, {"burst", std::int64_t{1}}, {"interval", 10.0}, {"spread", 5.0}},
        6);
    ASSERT_EQ(other->packets.size(), 1U);
    EXPECT_GT(other->packets[0].time, SimTime::from_seconds(0.01));
    EXPECT_LT(other->packets[0].time, SimTime::from_seconds(5.01));
}

TEST_F(SaturatingSourceTest, ItsQueueNeverRunsEmpty) {
    run("SaturatingSource", {{"destination", std::int64_t{1}}}, 1);
    constexpr auto dropped = static_cast<std::size_t>(MessageOutcome::queue_overflow);
    EXPECT_GT(network.message_outcomes().counts(MessageKind::unicast)[dropped], 0U);
    // Only frame, ACK and waiting: more than 2 Mbps at the default rate of 6 Mbps or more.
    EXPECT_GT(other->packets.size() * 8000, 2e6);
}

TEST_F(SaturatingSourceTest, ItselfIsNoDestination) {
    EXPECT_EQ(error_text([this] { run("SaturatingSource", {}, 1); }),
              "protocol.destination = 0: expected the id of another node than tested itself, from 0 to 1");
}

TEST_F(SaturatingSourceTest, ANodeThatIsNotThereIsNoDestination) {
    EXPECT_EQ(error_text([this] { run("SaturatingSource", {{"destination", std::int64_t{77}}}, 1); }),
              "protocol.destination = 77: expected the id of a node, from 0 to 1");
}

TEST(SaturatingSourceAlone, HasNoDestination) {
    Network network(MediumConfig(), 1);
    set_native_protocol(network.add_node(NodeConfig("node")), "SaturatingSource");
    EXPECT_EQ(
        error_text([&] { network.initialize(); }),
        "protocol.destination = 0: expected the id of another node than node itself, but there is no other");
}

}  // namespace
}  // namespace netsim
