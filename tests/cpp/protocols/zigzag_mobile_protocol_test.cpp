#include "protocols/zigzag_mobile_protocol.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "config/error_text.hpp"
#include "protocols/zigzag_message.hpp"
#include "support/pair_of_nodes.hpp"

namespace netsim {
namespace {

using zigzag::decode;
using zigzag::Message;

// The other node sends messages of the test at 10 s, 20 s, …
class ZigZagMobileTest : public test::PairOfNodes {
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

Parameters hovering() {
    return {{"speed", 0.0}};
}

TEST(ZigZagMobileProtocolOnANodeThatStands, IsRefused) {
    Network network(MediumConfig(), 1);
    NodeConfig config("node");
    config.mobility.type_name = "StationaryMobility";
    set_native_protocol(network.add_node(config), "ZigZagMobileProtocol");
    EXPECT_EQ(error_text([&] { network.initialize(); }),
              "mobility.typename: expected \"MasslessMobility\" for node, as ZigZagMobileProtocol flies");
}

TEST_F(ZigZagMobileTest, CollectsReadings) {
    hear({zigzag::SensorData{1}, zigzag::SensorData{1}});
    run("ZigZagMobileProtocol", hovering(), 30);
    EXPECT_EQ(tracked("data"), TrackedValue(std::int64_t{2}));
    EXPECT_EQ(tracked("collected"), TrackedValue(std::int64_t{2}));
}

TEST_F(ZigZagMobileTest, ItsHeartbeatsTellWhetherItIsAvailable) {
    run("ZigZagMobileProtocol", {{"speed", 0.0}, {"heartbeat_jitter", 0.0}, {"interaction_timeout", 1.5}},
        2.5);
    ASSERT_EQ(other->packets.size(), 2U);
    EXPECT_EQ(decode(other->packets[0].text), Message(zigzag::UavHeartbeat{0, false, false}));
    EXPECT_EQ(decode(other->packets[1].text), Message(zigzag::UavHeartbeat{0, false, true}));
}

TEST_F(ZigZagMobileTest, AsksForAnExchange) {
    hear({zigzag::SensorData{1}, zigzag::UavHeartbeat{1, false, true}, zigzag::UavHeartbeat{1, true, true},
          zigzag::GroundHeartbeat{1}});
    run("ZigZagMobileProtocol", hovering(), 50);
    // Both fly outward: the lower id carries. The other flies homeward: this one carries. The
    // station always carries.
    EXPECT_EQ(answers(), (std::vector<Message>{zigzag::PairRequest{0, 0, 0}, zigzag::PairRequest{0, 0, 0},
                                               zigzag::PairRequest{0, 1, 1}}));
}

TEST_F(ZigZagMobileTest, ConfirmsAndTurnsRound) {
    hear({zigzag::PairRequest{1, 0, 4}, zigzag::UavHeartbeat{1, true, true}});
    run("ZigZagMobileProtocol", hovering(), 30);
    // It is the carrier and flies homeward now, like the other one.
    EXPECT_EQ(answers(),
              (std::vector<Message>{zigzag::PairConfirmation{0, 0, 0}, zigzag::PairRequest{0, 0, 0}}));
    EXPECT_EQ(tracked("data"), TrackedValue(std::int64_t{4}));
    EXPECT_EQ(tracked("interactions"), TrackedValue(std::int64_t{1}));
}

TEST_F(ZigZagMobileTest, BeforeItsLaunchItHearsNothing) {
    auto sensor = std::make_unique<test::Recorder>(*tested);
    sensor->on_initialize = [](test::Recorder& self) {
        self.node.schedule_timer("", SimTime::from_seconds(10));
    };
    sensor->on_timer = [](test::Recorder& self, const std::string&) {
        self.node.send(1, zigzag::encode(zigzag::SensorData{0}));
    };
    tested->set_protocol(std::move(sensor));
    Node& uav = other->node;
    set_native_protocol(uav, "ZigZagMobileProtocol", {{"launch_interval", 100.0}});
    network.initialize();
    network.run_until(SimTime::from_seconds(50));
    EXPECT_EQ(network.message_outcomes().counts(
                  MessageKind::unicast)[static_cast<std::size_t>(MessageOutcome::acknowledged)],
              1U);
    EXPECT_EQ(uav.tracked_variables().values().front(),
              (std::pair<std::string, TrackedValue>("data", std::int64_t{0})));
}

}  // namespace
}  // namespace netsim
