#include "protocols/zigzag_ground_station_protocol.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "protocols/zigzag_message.hpp"
#include "support/pair_of_nodes.hpp"

namespace netsim {
namespace {

using zigzag::decode;
using zigzag::Message;

// The other node sends messages of the test at 10 s, 20 s, …
class ZigZagGroundStationTest : public test::PairOfNodes {
protected:
    void hear(const std::vector<Message>& messages) {
        other->on_initialize = [messages](test::Recorder& self) {
            double time_s = 0;
            for (const Message& message : messages) {
                self.node.schedule_timer(*zigzag::encode(message), SimTime::from_seconds(time_s += 10));
            }
        };
        other->on_timer = [](test::Recorder& self, const std::string& text) { self.send(0, text); };
    }
    // Messages of the tested node, without heartbeats.
    std::vector<Message> answers() const {
        std::vector<Message> result;
        for (const std::string& text : other->packet_texts()) {
            if (text.find("Heartbeat") == std::string::npos) {
                result.push_back(decode(text));
            }
        }
        return result;
    }
};

TEST_F(ZigZagGroundStationTest, SendsHeartbeats) {
    run("ZigZagGroundStationProtocol", {{"heartbeat_jitter", 0.0}}, 3.5);
    ASSERT_EQ(other->packets.size(), 3U);
    EXPECT_EQ(decode(other->packets[0].text), Message(zigzag::GroundHeartbeat{0}));
}

TEST_F(ZigZagGroundStationTest, AsksAUavThatIsAvailable) {
    hear({zigzag::UavHeartbeat{1, true, false}, zigzag::UavHeartbeat{1, true, true}});
    run("ZigZagGroundStationProtocol", {}, 30);
    EXPECT_EQ(answers(), (std::vector<Message>{zigzag::PairRequest{0, 0, 0}}));
}

TEST_F(ZigZagGroundStationTest, TakesWhatAUavSays) {
    hear(
        {zigzag::PairRequest{1, 0, 5}, zigzag::PairConfirmation{1, 0, 5}, zigzag::PairConfirmation{1, 0, 6}});
    run("ZigZagGroundStationProtocol", {}, 40);
    EXPECT_EQ(answers(), (std::vector<Message>{zigzag::PairConfirmation{0, 0, 0}}));
    EXPECT_EQ(tracked("data"), TrackedValue(std::int64_t{6}));
    EXPECT_EQ(tracked("deliveries"), TrackedValue(std::int64_t{2}));
}

}  // namespace
}  // namespace netsim
