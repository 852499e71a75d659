#include "protocols/sink_protocol.hpp"

#include <string>

#include <gtest/gtest.h>

#include "support/pair_of_nodes.hpp"

namespace netsim {
namespace {

class SinkProtocolTest : public test::PairOfNodes {
protected:
    // Messages at 1 s and 2 s.
    SinkProtocolTest() {
        other->on_initialize = [](test::Recorder& self) {
            self.node.schedule_timer("text", SimTime::from_seconds(1));
            self.node.schedule_timer("grün", SimTime::from_seconds(2));
        };
        other->on_timer = [](test::Recorder& self, const std::string& text) { self.broadcast(text); };
    }
};

TEST_F(SinkProtocolTest, CountsMessagesAndTheirCharacters) {
    run("SinkProtocol", {}, 3);
    EXPECT_EQ(tracked("received"), TrackedValue(std::int64_t{2}));
    EXPECT_EQ(tracked("received_bytes"), TrackedValue(std::int64_t{8}));
}

TEST_F(SinkProtocolTest, LeavesOutWhatComesBefore) {
    run("SinkProtocol", {{"count_from", 1.5}}, 3);
    EXPECT_EQ(tracked("received"), TrackedValue(std::int64_t{1}));
}

}  // namespace
}  // namespace netsim
