#include "netsim/node/network.hpp"

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "support/recorder.hpp"
#include "support/silent_node.hpp"

namespace netsim {
namespace {

using test::Recorder;
using test::silent_node;

SimTime s(double seconds) {
    return SimTime::from_seconds(seconds);
}

TEST(Network, NodesGetTheirIdsInTheOrderOfAdding) {
    Network network(MediumConfig(), 1);
    for (NodeId id = 0; id < 3; ++id) {
        EXPECT_EQ(network.add_node(silent_node()).id(), id);
    }
    EXPECT_EQ(network.node_count(), 3);
    EXPECT_EQ(network.node(2).id(), 2);
}

TEST(Network, ReferencesToNodesStayValid) {
    Network network(MediumConfig(), 1);
    const Node& first = network.add_node(silent_node());
    for (int i = 0; i < 1000; ++i) {
        network.add_node(silent_node());
    }
    EXPECT_EQ(&first, &network.node(0));
}

TEST(Network, ANodeOfAnotherIdIsAnError) {
    Network network(MediumConfig(), 1);
    network.add_node(silent_node());
    EXPECT_THROW(network.node(1), SimulationError);
    EXPECT_THROW(network.node(-1), SimulationError);
}

TEST(Network, ChecksItsConfigurations) {
    MediumConfig medium;
    medium.alpha = -1;
    EXPECT_THROW(Network(medium, 1), ConfigError);
    Network network(MediumConfig(), 1);
    NodeConfig node = silent_node();
    node.wlan[0].radio.tx_power_w = -1;
    EXPECT_THROW(network.add_node(node), ConfigError);
}

TEST(Network, ARefusedNodeLeavesNoTrace) {
    Network network(MediumConfig(), 1);
    NodeConfig wrong = silent_node();
    wrong.wlan[0].mac.bitrate_bps = 7e6;  // detected only when the layers are built
    EXPECT_THROW(network.add_node(wrong), ConfigError);
    EXPECT_EQ(network.node_count(), 0);
    Recorder& sender = test::add_recorder(network, silent_node());
    const Recorder& receiver = test::add_recorder(network, silent_node());
    sender.on_initialize = [](Recorder& self) { self.broadcast("text"); };
    network.initialize();
    network.run_until(s(1));
    EXPECT_EQ(sender.node.id(), 0);
    EXPECT_EQ(receiver.packets.size(), 1U);
}

TEST(Network, InitializesAndFinishesInTheOrderOfIds) {
    std::vector<std::string> order;
    Network network(MediumConfig(), 1);
    for (int id = 0; id < 3; ++id) {
        Recorder& recorder = test::add_recorder(network, silent_node());
        recorder.on_initialize = [&order](Recorder& self) {
            order.push_back("initialize " + std::to_string(self.node.id()));
        };
        recorder.on_finish = [&order](Recorder& self) {
            order.push_back("finish " + std::to_string(self.node.id()));
        };
    }
    network.initialize();
    network.run_until(s(1));
    network.finish();
    EXPECT_EQ(order, (std::vector<std::string>{"initialize 0", "initialize 1", "initialize 2", "finish 0",
                                               "finish 1", "finish 2"}));
}

TEST(Network, NothingRunsBeforeInitialize) {
    Network network(MediumConfig(), 1);
    network.add_node(silent_node());
    EXPECT_THROW(network.run_until(s(1)), SimulationError);
    EXPECT_THROW(network.step(s(1)), SimulationError);
    network.initialize();
    EXPECT_NO_THROW(network.run_until(s(1)));
}

TEST(Network, IsInitializedOnce) {
    Network network(MediumConfig(), 1);
    Recorder& sender = test::add_recorder(network, silent_node());
    const Recorder& receiver = test::add_recorder(network, silent_node());
    sender.on_initialize = [](Recorder& self) { self.broadcast("text"); };
    network.initialize();
    EXPECT_THROW(network.initialize(), SimulationError);
    network.run_until(s(1));
    EXPECT_EQ(receiver.packets.size(), 1U);
}

TEST(Network, WhoNeverBeganIsNotFinished) {
    Network network(MediumConfig(), 1);
    const Recorder& recorder = test::add_recorder(network, silent_node());
    network.finish();
    EXPECT_TRUE(recorder.finished.empty());
}

TEST(Network, NothingRunsAfterFinish) {
    Network network(MediumConfig(), 1);
    const Recorder& recorder = test::add_recorder(network, silent_node());
    network.initialize();
    network.finish();
    EXPECT_THROW(network.finish(), SimulationError);
    EXPECT_THROW(network.run_until(s(1)), SimulationError);
    EXPECT_THROW(network.step(s(1)), SimulationError);
    EXPECT_EQ(recorder.finished.size(), 1U);
}

TEST(Network, NothingRunsIfACheckRefusesAProtocol) {
    struct Refused final : Protocol {
        void check() const override { throw ConfigError("wrong"); }
        void initialize() override {}
        void handle_timer(const std::string&) override {}
        void handle_packet(const Payload&) override {}
        void handle_telemetry(const Position&) override {}
        void finish() override {}
    };
    Network network(MediumConfig(), 1);
    network.add_node(silent_node()).set_protocol(std::make_unique<Refused>());
    EXPECT_THROW(network.initialize(), ConfigError);
    EXPECT_THROW(network.run_until(s(1)), SimulationError);
}

TEST(Network, ANodeThatComesAfterInitializeIsRefused) {
    Network network(MediumConfig(), 1);
    network.initialize();
    EXPECT_THROW(network.add_node(silent_node()), SimulationError);
    EXPECT_EQ(network.node_count(), 0);
}

TEST(Network, MessagesSentInInitializeAreDelivered) {
    for (const std::string_view medium : medium_type_names) {
        Network network(MediumConfig(std::string(medium)), 1);
        Recorder& sender = test::add_recorder(network, silent_node());
        const Recorder& receiver = test::add_recorder(network, silent_node({10, 0, 0}));
        sender.on_initialize = [](Recorder& self) {
            self.broadcast("to all");
            self.send(1, "to you");
        };
        network.initialize();
        network.run_until(s(1));
        EXPECT_EQ(receiver.packet_texts(), (std::vector<std::string>{"to all", "to you"})) << medium;
    }
}

TEST(Network, ANodeWithoutAProtocolIsARadioThatListens) {
    Network network(MediumConfig(), 1);
    Recorder& sender = test::add_recorder(network, silent_node());
    network.add_node(silent_node({10, 0, 0}));
    sender.on_initialize = [](Recorder& self) { self.send(1, "text"); };
    network.initialize();
    network.run_until(s(1));
    network.finish();
    const auto counts = network.message_outcomes().counts(MessageKind::unicast);
    EXPECT_EQ(counts[static_cast<std::size_t>(MessageOutcome::acknowledged)], 1U);
}

TEST(Network, AnExceptionOfAProtocolEndsRunUntil) {
    Network network(MediumConfig(), 1);
    Recorder& recorder = test::add_recorder(network, silent_node());
    recorder.on_initialize = [](Recorder& self) { self.node.schedule_timer("tick", s(2)); };
    recorder.on_timer = [](Recorder&, const std::string&) { throw std::runtime_error("of the protocol"); };
    network.initialize();
    EXPECT_THROW(network.run_until(s(10)), std::runtime_error);
    EXPECT_EQ(network.now(), s(2));
}

TEST(Network, AfterAnExceptionOfOneReceiverTheOthersGetTheFrame) {
    Network network(MediumConfig(), 1);
    Recorder& sender = test::add_recorder(network, silent_node());
    Recorder& near = test::add_recorder(network, silent_node({10, 0, 0}));
    Recorder& far = test::add_recorder(network, silent_node({20, 0, 0}));
    sender.on_initialize = [](Recorder& self) { self.broadcast("text"); };
    near.on_packet = [](Recorder&, const std::string&) { throw std::runtime_error("of the protocol"); };
    network.initialize();
    EXPECT_THROW(network.run_until(s(1)), std::runtime_error);
    EXPECT_TRUE(far.packets.empty());
    network.run_until(s(1));
    EXPECT_EQ(far.packet_texts(), std::vector<std::string>{"text"});
}

TEST(Network, RunsWhatIsScheduledBesideItsNodes) {
    Network network(MediumConfig{}, 1);
    SimTime ran;
    network.initialize();
    network.schedule(s(2), [&] { ran = network.now(); });
    EXPECT_EQ(network.pending_count(), 1U);
    EXPECT_TRUE(network.step(s(5)));
    EXPECT_FALSE(network.step(s(5)));
    EXPECT_EQ(ran, s(2));
    EXPECT_THROW(network.schedule(s(1), [] {}), SimulationError);
}

TEST(Network, WhatWasScheduledIsReleasedWithTheProtocols) {
    Network network(MediumConfig{}, 1);
    const auto owned = std::make_shared<int>();
    network.schedule(s(2), [owned] {});
    network.release_protocols();
    EXPECT_EQ(owned.use_count(), 1);
    EXPECT_EQ(network.pending_count(), 0U);
}

TEST(Network, ReleasedProtocolsAreGone) {
    struct Tracked final : Protocol {
        explicit Tracked(bool& flag) : gone(flag) {}
        Tracked(const Tracked&) = delete;
        Tracked& operator=(const Tracked&) = delete;
        ~Tracked() override { gone = true; }
        void initialize() override {}
        void handle_timer(const std::string&) override {}
        void handle_packet(const Payload&) override {}
        void handle_telemetry(const Position&) override {}
        void finish() override {}
        bool& gone;
    };
    bool gone = false;
    Network network(MediumConfig(), 1);
    network.add_node(silent_node()).set_protocol(std::make_unique<Tracked>(gone));
    network.release_protocols();
    EXPECT_TRUE(gone);
    EXPECT_EQ(network.node(0).protocol(), nullptr);
}

}  // namespace
}  // namespace netsim
