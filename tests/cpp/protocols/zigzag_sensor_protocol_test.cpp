#include "protocols/zigzag_sensor_protocol.hpp"

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
class ZigZagSensorTest : public test::PairOfNodes {
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

TEST_F(ZigZagSensorTest, AnswersTheHeartbeatsOfUavsOnly) {
    hear({zigzag::UavHeartbeat{1, false, false}, zigzag::GroundHeartbeat{1}});
    run("ZigZagSensorProtocol", {}, 30);
    EXPECT_EQ(answers(), (std::vector<Message>{zigzag::SensorData{0}}));
    EXPECT_EQ(tracked("answered"), TrackedValue(std::int64_t{1}));
}

}  // namespace
}  // namespace netsim
