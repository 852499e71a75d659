// Networks whose stations have different operation modes: frames in unsupported modes are noise.
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/node/network.hpp"
#include "support/recorder.hpp"
#include "support/silent_node.hpp"

namespace netsim {
namespace {

using test::Recorder;

NodeConfig station(const std::string& op_mode, Position position = {}, double bitrate_bps = -1) {
    NodeConfig config = test::silent_node(position);
    config.wlan[0].mac.op_mode = op_mode;
    config.wlan[0].mac.bitrate_bps = bitrate_bps;
    return config;
}

void run(Network& network) {
    network.initialize();
    network.run_until(SimTime::from_seconds(1));
}

struct Pair {
    std::string sender;
    double bitrate_bps;
    std::string receiver;
    bool is_heard;
};

class OperationModes : public testing::TestWithParam<Pair> {};

TEST_P(OperationModes, AStationHearsWhatItsOwnModeHas) {
    Network network(MediumConfig(), 1);
    Recorder& sender = test::add_recorder(network, station(GetParam().sender, {}, GetParam().bitrate_bps));
    Recorder& receiver = test::add_recorder(network, station(GetParam().receiver, {10, 0, 0}));
    sender.on_initialize = [](Recorder& self) { self.broadcast("text"); };
    run(network);
    EXPECT_EQ(receiver.packets.size(), GetParam().is_heard ? 1U : 0U);
    EXPECT_EQ(network.frame_outcomes().copies(FrameKind::broadcast, false), GetParam().is_heard ? 1U : 0U);
}

INSTANTIATE_TEST_SUITE_P(All, OperationModes,
                         testing::Values(Pair{"b", -1, "b", true},                 //
                                         Pair{"b", -1, "g(mixed)", true},          //
                                         Pair{"b", -1, "g(erp)", false},           //
                                         Pair{"b", -1, "a", false},                //
                                         Pair{"g(erp)", -1, "g(mixed)", true},     //
                                         Pair{"g(erp)", -1, "b", false},           //
                                         Pair{"g(erp)", -1, "a", false},           //
                                         Pair{"g(mixed)", 11e6, "b", true},        //
                                         Pair{"g(mixed)", 24e6, "b", false},       //
                                         Pair{"g(mixed)", 11e6, "g(erp)", false},  //
                                         Pair{"g(mixed)", 24e6, "g(erp)", true},   //
                                         Pair{"a", -1, "a", true},                 //
                                         Pair{"a", -1, "g(mixed)", false}));

TEST(Network, AMessageInAModeThatTheAddresseeHasNotIsGivenUp) {
    Network network(MediumConfig(), 1);
    Recorder& sender = test::add_recorder(network, station("g(erp)"));
    test::add_recorder(network, station("b", {10, 0, 0}));
    sender.on_initialize = [](Recorder& self) { self.send(1, "text"); };
    run(network);
    EXPECT_EQ(network.message_outcomes().counts(
                  MessageKind::unicast)[static_cast<std::size_t>(MessageOutcome::retry_limit)],
              1U);
}

TEST(Network, AFrameThatAStationCannotDecodeMakesItsChannelBusy) {
    Network network(MediumConfig(), 1);
    Recorder& first = test::add_recorder(network, station("g(erp)", {}, 6e6));
    Recorder& second = test::add_recorder(network, station("b", {10, 0, 0}));
    Recorder& receiver = test::add_recorder(network, station("g(mixed)", {20, 0, 0}));
    // The frame takes 2 ms, during which another station wants to send.
    first.on_initialize = [](Recorder& self) { self.broadcast(std::string(1400, '1')); };
    second.on_initialize = [](Recorder& self) { self.node.schedule_timer("send", SimTime::from_us(1000)); };
    second.on_timer = [](Recorder& self, const std::string&) { self.broadcast("2"); };
    run(network);
    EXPECT_EQ(receiver.packet_texts(), (std::vector<std::string>{std::string(1400, '1'), "2"}));
}

TEST(Network, AFrameThatAStationCannotDecodeDisturbsWhatItReceives) {
    Network network(MediumConfig(), 1);
    // Too weak for the sender, 300 m away, and ten times as strong as its frame at the receiver.
    NodeConfig hidden = station("g(erp)", {10, 0, 0}, 6e6);
    hidden.wlan[0].radio.tx_power_w = 1e-4;
    Recorder& disturber = test::add_recorder(network, hidden);
    test::add_recorder(network, station("b"));
    Recorder& sender = test::add_recorder(network, station("b", {-300, 0, 0}));
    disturber.on_initialize = [](Recorder& self) { self.broadcast(std::string(1400, '1')); };
    sender.on_initialize = [](Recorder& self) { self.node.schedule_timer("send", SimTime::from_us(1000)); };
    sender.on_timer = [](Recorder& self, const std::string&) { self.broadcast("2"); };
    run(network);
    EXPECT_EQ(network.frame_outcomes().counts_at(
                  1, FrameKind::broadcast)[static_cast<std::size_t>(FrameOutcome::interference)],
              1U);
    EXPECT_EQ(network.frame_outcomes().interferers_at(1), (std::map<NodeId, std::uint64_t>{{0, 1}}));
}

}  // namespace
}  // namespace netsim
