// Networks whose nodes have several interfaces, or interfaces of both kinds.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "netsim/node/network.hpp"
#include "support/recorder.hpp"
#include "support/silent_node.hpp"

namespace netsim {
namespace {

using test::Recorder;
using test::silent_node;

SimTime s(double seconds) {
    return SimTime::from_seconds(seconds);
}

NodeConfig device(Position position = {}) {
    NodeConfig config("sensor", {std::string(ieee802154_interface)});
    config.initial_position = position;
    config.mobility.telemetry_interval_s = 0;
    return config;
}

TEST(Network, NodesOfBothInterfacesNeitherHearNorDisturbEachOther) {
    Network network(MediumConfig(), 1);
    Recorder& station = test::add_recorder(network, silent_node());
    Recorder& sensor = test::add_recorder(network, device({10, 0, 0}));
    Recorder& other_station = test::add_recorder(network, silent_node({20, 0, 0}));
    Recorder& other_sensor = test::add_recorder(network, device({30, 0, 0}));
    station.on_initialize = sensor.on_initialize = [](Recorder& self) {
        for (int i = 0; i < 20; ++i) self.broadcast(self.node.name());
    };
    network.initialize();
    network.run_until(s(1));
    EXPECT_EQ(other_station.packet_texts(), std::vector<std::string>(20, "node"));
    EXPECT_EQ(other_sensor.packet_texts(), std::vector<std::string>(20, "sensor"));
    EXPECT_TRUE(station.packets.empty() && sensor.packets.empty());
    EXPECT_EQ(network.frame_outcomes().copies(FrameKind::broadcast, false),
              40U);  // only those in the sender's band
}

TEST(Network, AMessageToANodeOfAnotherBandIsGivenUp) {
    Network network(MediumConfig(), 1);
    Recorder& sensor = test::add_recorder(network, device());
    network.add_node(silent_node());
    sensor.on_initialize = [](Recorder& self) { self.send(1, "anybody there?"); };
    network.initialize();
    network.run_until(s(1));
    EXPECT_EQ(network.message_outcomes().counts(
                  MessageKind::unicast)[static_cast<std::size_t>(MessageOutcome::retry_limit)],
              1U);
}

constexpr double channel_1_hz = 2.412e9;
constexpr double channel_6_hz = 2.437e9;

NodeConfig node_on(const std::vector<double>& carriers_hz, Position position = {}) {
    NodeConfig config("node", std::vector<std::string>(carriers_hz.size(), std::string(ieee80211_interface)));
    for (std::size_t index = 0; index < carriers_hz.size(); ++index) {
        config.wlan[index].radio.carrier_hz = carriers_hz[index];
    }
    config.initial_position = position;
    config.mobility.telemetry_interval_s = 0;
    return config;
}

TEST(Network, ANodeWithTwoInterfacesHearsBothChannelsAndSendsOnTheOneItIsTold) {
    Network network(MediumConfig(), 1);
    Recorder& low = test::add_recorder(network, node_on({channel_1_hz}));
    Recorder& relay = test::add_recorder(network, node_on({channel_1_hz, channel_6_hz}, {10, 0, 0}));
    Recorder& high = test::add_recorder(network, node_on({channel_6_hz}, {20, 0, 0}));
    low.on_initialize = [](Recorder& self) { self.send(1, "from below"); };
    high.on_initialize = [](Recorder& self) { self.send(1, "from above"); };
    relay.on_packet = [](Recorder& self, const std::string& text) {
        self.broadcast("heard " + text, text == "from below" ? 1 : 0);
    };
    network.initialize();
    network.run_until(s(1));
    EXPECT_EQ(low.packet_texts(), std::vector<std::string>{"heard from above"});
    EXPECT_EQ(high.packet_texts(), std::vector<std::string>{"heard from below"});
    EXPECT_EQ(network.message_outcomes().counts(
                  MessageKind::unicast)[static_cast<std::size_t>(MessageOutcome::acknowledged)],
              2U);
    // The sender's other interface is not involved.
    EXPECT_EQ(network.frame_outcomes().copies(FrameKind::broadcast, false), 2U);
}

TEST(Network, EachInterfaceTellsWhatBecameOfItsMessages) {
    Network network(MediumConfig(), 1);
    Recorder& relay = test::add_recorder(network, node_on({channel_1_hz, channel_6_hz}));
    network.add_node(node_on({channel_1_hz}, {10, 0, 0}));
    relay.on_initialize = [](Recorder& self) {
        self.send(1, "there");
        self.send(1, "not there", 1);
        self.broadcast("to nobody", 1);
    };
    network.initialize();
    network.run_until(s(1));
    const auto count_of = [&network](std::size_t interface, MessageKind kind, MessageOutcome outcome) {
        return network.node(0).interfaces()[interface]->message_outcomes().counts(
            kind)[static_cast<std::size_t>(outcome)];
    };
    EXPECT_EQ(count_of(0, MessageKind::unicast, MessageOutcome::acknowledged), 1U);
    EXPECT_EQ(count_of(0, MessageKind::unicast, MessageOutcome::retry_limit), 0U);
    EXPECT_EQ(count_of(0, MessageKind::broadcast, MessageOutcome::sent), 0U);
    EXPECT_EQ(count_of(1, MessageKind::unicast, MessageOutcome::acknowledged), 0U);
    EXPECT_EQ(count_of(1, MessageKind::unicast, MessageOutcome::retry_limit), 1U);
    EXPECT_EQ(count_of(1, MessageKind::broadcast, MessageOutcome::sent), 1U);
}

TEST(Network, AnInterfaceThatIsNotThereCannotSend) {
    Network network(MediumConfig(), 1);
    Recorder& sender = test::add_recorder(network, node_on({channel_1_hz, channel_6_hz}));
    network.initialize();
    for (const std::int32_t interface : {-1, 2}) {
        try {
            sender.broadcast("text", interface);
            FAIL();
        } catch (const SimulationError& error) {
            EXPECT_EQ(std::string(error.what()), "node 0 has no interface wlan[" + std::to_string(interface) +
                                                     "]: it has 2, from wlan[0] on");
        }
    }
}

TEST(Network, AnInterfaceThatNobodyUsesLeavesTheCourseOfARunUnchanged) {
    const auto fingerprint_with = [](const std::vector<double>& carriers_hz) {
        MediumConfig medium;
        medium.path_loss = "RayleighFading";
        Network network(medium, 7);
        for (int i = 0; i < 10; ++i) {
            Recorder& node = test::add_recorder(network, node_on(carriers_hz, {i * 150.0, 0, 0}));
            node.on_initialize = [](Recorder& self) {
                for (int j = 0; j < 10; ++j) self.broadcast("text");
            };
        }
        network.initialize();
        network.run_until(s(1));
        return network.fingerprint();
    };
    EXPECT_EQ(fingerprint_with({channel_1_hz}), fingerprint_with({channel_1_hz, channel_6_hz}));
}

TEST(Network, OnAPerfectChannelItMakesNoDifferenceWhichInterfaceSends) {
    Network network(MediumConfig(std::string(unit_disk_medium)), 1);
    Recorder& sender = test::add_recorder(network, node_on({channel_1_hz, channel_6_hz}));
    Recorder& receiver = test::add_recorder(network, node_on({channel_1_hz, channel_6_hz}, {10, 0, 0}));
    sender.on_initialize = [](Recorder& self) {
        self.broadcast("first");
        self.send(1, "second", 1);
    };
    network.initialize();
    network.run_until(s(1));
    EXPECT_EQ(receiver.packet_texts(), (std::vector<std::string>{"first", "second"}));
}

TEST(Network, OnAPerfectChannelEachInterfaceHasItsRange) {
    Network network(MediumConfig(std::string(unit_disk_medium)), 1);
    NodeConfig config = node_on({channel_1_hz, channel_6_hz});
    config.wlan[1].radio.communication_range_m = 5;
    Recorder& sender = test::add_recorder(network, config);
    Recorder& receiver = test::add_recorder(network, silent_node({10, 0, 0}));
    sender.on_initialize = [](Recorder& self) {
        self.broadcast("first");
        self.broadcast("second", 1);
    };
    network.initialize();
    network.run_until(s(1));
    EXPECT_EQ(receiver.packet_texts(), std::vector<std::string>{"first"});
}

TEST(Network, InterfacesOfOneNodeCannotShareACentreFrequency) {
    Network network(MediumConfig(), 1);
    try {
        network.add_node(node_on({channel_1_hz, channel_6_hz, channel_1_hz}));
        FAIL();
    } catch (const ConfigError& error) {
        EXPECT_EQ(std::string(error.what()),
                  "wlan[2].radio.carrier_hz = 2412000000 Hz: expected another channel than that of wlan[0] "
                  "of node");
    }
    EXPECT_EQ(network.node_count(), 0);
}

TEST(Network, OnAPerfectChannelNobodyReadsCentreFrequencies) {
    Network network(MediumConfig(std::string(unit_disk_medium)), 1);
    EXPECT_NO_THROW(network.add_node(node_on({channel_1_hz, channel_1_hz})));
}

TEST(Network, ACaptureIsOfOneInterface) {
    Network network(MediumConfig(), 1);
    network.add_node(node_on({channel_1_hz, channel_6_hz}));
    const auto error_of = [&](std::int32_t interface) -> std::string {
        try {
            network.capture(0, "/dev/null", interface);
        } catch (const ConfigError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(error_of(0), "");
    EXPECT_EQ(error_of(1), "");
    EXPECT_EQ(error_of(1), "the frames of wlan[1] of node are captured already");
    EXPECT_EQ(error_of(2),
              "cannot capture the frames of wlan[2] of node, which has 2 interfaces, from wlan[0] on");
}

TEST(Network, InterfacesOfTwoKindsCannotShareACentreFrequency) {
    Network network(MediumConfig(), 1);
    network.add_node(silent_node());
    NodeConfig config = device();
    config.wlan[0].radio.carrier_hz = 2.412e9;
    try {
        network.add_node(config);
        FAIL();
    } catch (const ConfigError& error) {
        ASSERT_NE(error.problem(), nullptr);
        EXPECT_EQ(error.problem()->field, "radio.carrier_hz");
        EXPECT_NE(std::string(error.what()).find("sensor"), std::string::npos);
    }
    EXPECT_EQ(network.node_count(), 1);
}

TEST(Network, APerfectChannelTakesNodesOfBothInterfaces) {
    Network network(MediumConfig("UnitDiskRadioMedium"), 1);
    Recorder& station = test::add_recorder(network, silent_node());
    Recorder& sensor = test::add_recorder(network, device());
    sensor.on_initialize = [](Recorder& self) { self.send(0, "hello"); };
    network.initialize();
    network.run_until(s(1));
    EXPECT_EQ(station.packet_texts(), std::vector<std::string>{"hello"});
}

}  // namespace
}  // namespace netsim
