#include "protocols/flood_protocol.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "config/error_text.hpp"
#include "netsim/error.hpp"
#include "support/pair_of_nodes.hpp"

namespace netsim {
namespace {

class FloodProtocolTest : public test::PairOfNodes {
protected:
    // The other node broadcasts these at 1 s, 2 s, …
    void hear(const std::vector<std::string>& texts) {
        other->on_initialize = [texts](test::Recorder& self) {
            double time_s = 0;
            for (const std::string& text : texts) {
                self.node.schedule_timer(text, SimTime::from_seconds(time_s += 1));
            }
        };
        other->on_timer = [](test::Recorder& self, const std::string& text) { self.broadcast(text); };
    }
    Parameters far_origin{{"origin", std::int64_t{1}}, {"payload_bytes", std::int64_t{6}}};
};

TEST_F(FloodProtocolTest, TheOriginNumbersItsMessages) {
    run("FloodProtocol", {{"payload_bytes", std::int64_t{6}}, {"stop", 2.5}}, 5);
    EXPECT_EQ(other->packet_texts(), (std::vector<std::string>{"0 1 xx", "1 1 xx"}));
}

TEST_F(FloodProtocolTest, WhatIsNewIsRelayedOnce) {
    hear({"0 1 xx", "0 2 xx", "1 3 xx"});
    run("FloodProtocol", far_origin, 5);
    EXPECT_EQ(other->packet_texts(), (std::vector<std::string>{"0 2 xx", "1 4 xx"}));
    EXPECT_EQ(tracked("received"), TrackedValue(std::int64_t{2}));
    EXPECT_EQ(tracked("duplicates"), TrackedValue(std::int64_t{1}));
    EXPECT_EQ(tracked("most_hops"), TrackedValue(std::int64_t{3}));
}

TEST_F(FloodProtocolTest, AtTheHopLimitAMessageEnds) {
    hear({"0 1 xx", "1 2 xx"});
    far_origin["hop_limit"] = std::int64_t{2};
    run("FloodProtocol", far_origin, 5);
    EXPECT_EQ(other->packet_texts(), std::vector<std::string>{"0 2 xx"});
}

TEST_F(FloodProtocolTest, AnOriginThatIsNotThereIsRefused) {
    const auto error = [this] { run("FloodProtocol", {{"origin", std::int64_t{2}}}, 1); };
    EXPECT_EQ(error_text(error), "protocol.origin = 2: expected the id of a node, from 0 to 1");
}

TEST_F(FloodProtocolTest, AnotherTextEndsTheRun) {
    hear({"hello"});
    EXPECT_THROW(run("FloodProtocol", far_origin, 5), SimulationError);
}

}  // namespace
}  // namespace netsim
