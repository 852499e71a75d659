#include "netsim/node/network.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "support/narrowband_scenario.hpp"
#include "support/random_scenario.hpp"
#include "support/recorder.hpp"
#include "support/silent_node.hpp"

namespace netsim {
namespace {

using test::RandomScenario;
using test::Recorder;
using test::ScenarioRun;
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
    EXPECT_THROW(network.node(1), std::out_of_range);
    EXPECT_THROW(network.node(-1), std::out_of_range);
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
    wrong.wlan[0].mac.bitrate_bps = 7e6;  // found out only when the layers are built
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
    const auto counts = network.message_fates().counts(MessageKind::unicast);
    EXPECT_EQ(counts[static_cast<std::size_t>(MessageFate::acknowledged)], 1U);
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

// Long after the last message was handed over: nothing is on the air or in a queue.
SimTime long_after(const RandomScenario& scenario) {
    return scenario.talk.until + s(60);
}

std::uint64_t sum_of(const auto& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

constexpr std::array all_frame_kinds{FrameKind::broadcast, FrameKind::unicast, FrameKind::ack, FrameKind::rts,
                                     FrameKind::cts};

class Balance : public testing::TestWithParam<std::uint64_t> {
protected:
    // One of 802.11 stations, one with 802.15.4 devices.
    static std::array<RandomScenario, 2> scenarios() {
        return {test::make_random_scenario(GetParam()), test::make_narrowband_scenario(GetParam())};
    }
    static void expect_balance(const Network& network) {
        for (const FrameKind kind : all_frame_kinds) {
            for (const bool overheard : {false, true}) {
                EXPECT_EQ(sum_of(network.frame_fates().counts(kind, overheard)),
                          network.frame_fates().copies(kind, overheard));
            }
        }
        std::uint64_t queued = 0;
        for (const MessageKind kind : {MessageKind::broadcast, MessageKind::unicast}) {
            const auto counts = network.message_fates().counts(kind);
            EXPECT_EQ(sum_of(counts), network.message_fates().accepted(kind));
            queued += counts[static_cast<std::size_t>(MessageFate::queued)];
        }
        std::uint64_t census = 0;
        for (NodeId id = 0; id < network.node_count(); ++id) {
            for (const auto& interface : network.node(id).interfaces()) {
                census += interface->queued_messages();
            }
        }
        EXPECT_EQ(queued, census);
    }
    // Fates at the receivers, without those that are kept only in sum.
    static void expect_nodes_add_up(const Network& network) {
        for (const FrameKind kind : all_frame_kinds) {
            FrameFates::Counts sums{};
            for (const bool overheard : {false, true}) {
                const auto counts = network.frame_fates().counts(kind, overheard);
                std::transform(sums.begin(), sums.end(), counts.begin(), sums.begin(), std::plus<>());
            }
            sums[static_cast<std::size_t>(FrameFate::below_sensitivity)] = 0;
            sums[static_cast<std::size_t>(FrameFate::in_air)] = 0;
            FrameFates::Counts at_nodes{};
            for (NodeId id = 0; id < network.node_count(); ++id) {
                const auto counts = network.frame_fates().counts_at(id, kind);
                std::transform(at_nodes.begin(), at_nodes.end(), counts.begin(), at_nodes.begin(),
                               std::plus<>());
            }
            EXPECT_EQ(at_nodes, sums);
        }
    }
};

TEST_P(Balance, HoldsAtEveryMomentOfARun) {
    for (const RandomScenario& scenario : scenarios()) {
        ScenarioRun run(scenario);
        for (int step = 1; step <= 20; ++step) {
            run.network.run_until(SimTime::from_ps(scenario.talk.until.ps() / 20 * step));
            expect_balance(run.network);
            expect_nodes_add_up(run.network);
        }
    }
}

TEST_P(Balance, NothingIsLeftWhenTheAirIsDrained) {
    for (const RandomScenario& scenario : scenarios()) {
        ScenarioRun run(scenario);
        run.network.run_until(long_after(scenario));
        expect_balance(run.network);
        for (const FrameKind kind : all_frame_kinds) {
            for (const bool overheard : {false, true}) {
                EXPECT_EQ(run.network.frame_fates().counts(
                              kind, overheard)[static_cast<std::size_t>(FrameFate::in_air)],
                          0U);
            }
        }
        for (const MessageKind kind : {MessageKind::broadcast, MessageKind::unicast}) {
            EXPECT_EQ(run.network.message_fates().counts(kind)[static_cast<std::size_t>(MessageFate::queued)],
                      0U);
        }
    }
}

TEST_P(Balance, AFrameOnTheAirIsAMessageOrAnAnswer) {
    const RandomScenario scenario = test::make_random_scenario(GetParam());
    ScenarioRun run(scenario);
    run.network.run_until(long_after(scenario));
    const FrameFates& frames = run.network.frame_fates();
    const auto broadcasts = run.network.message_fates().counts(MessageKind::broadcast);
    EXPECT_EQ(frames.frames(FrameKind::broadcast), broadcasts[static_cast<std::size_t>(MessageFate::sent)]);
    const auto unicasts = frames.counts(FrameKind::unicast, false);
    EXPECT_EQ(frames.frames(FrameKind::ack), unicasts[static_cast<std::size_t>(FrameFate::delivered)]);
    const auto requests = frames.counts(FrameKind::rts, false);
    EXPECT_LE(frames.frames(FrameKind::cts), requests[static_cast<std::size_t>(FrameFate::delivered)]);
}

TEST(RandomScenario, AsksAndPermitsOften) {
    std::uint64_t requests = 0;
    std::uint64_t permissions = 0;
    for (std::uint64_t seed = 100'000; seed < 100'060; ++seed) {
        const RandomScenario scenario = test::make_random_scenario(seed);
        ScenarioRun run(scenario);
        run.network.run_until(long_after(scenario));
        requests += run.network.frame_fates().frames(FrameKind::rts);
        permissions += run.network.frame_fates().frames(FrameKind::cts);
    }
    EXPECT_GE(requests, 1000U);
    EXPECT_GE(permissions, 300U);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Balance, testing::Range<std::uint64_t>(100'000, 100'060));

std::uint64_t fingerprint_of(const RandomScenario& scenario) {
    ScenarioRun run(scenario);
    run.network.run_until(long_after(scenario));
    return run.network.fingerprint();
}

TEST(Fingerprints, OfOneSeedAreEqual) {
    const RandomScenario scenario = test::make_random_scenario(5);
    EXPECT_EQ(fingerprint_of(scenario), fingerprint_of(scenario));
}

TEST(Fingerprints, OfAnotherSeedAreOther) {
    RandomScenario scenario = test::make_random_scenario(5);
    const std::uint64_t fingerprint = fingerprint_of(scenario);
    ++scenario.seed;  // of the network; what the protocols do stays the same
    EXPECT_NE(fingerprint_of(scenario), fingerprint);
}

TEST(Fingerprints, DoNotDependOnTheStepsOfRunUntil) {
    const RandomScenario scenario = test::make_random_scenario(5);
    ScenarioRun run(scenario);
    while (!run.network.run_until(long_after(scenario), 7)) {
    }
    EXPECT_EQ(run.network.fingerprint(), fingerprint_of(scenario));
}

TEST(Fingerprints, OfTwoNetworksThatRunInterleavedAreThoseOfEachAlone) {
    for (std::uint64_t seed = 10; seed < 20; ++seed) {
        const RandomScenario one = test::make_random_scenario(seed);
        const RandomScenario other = test::make_random_scenario(seed + 1000);
        ScenarioRun first(one);
        ScenarioRun second(other);
        bool first_done = false;
        bool second_done = false;
        while (!first_done || !second_done) {
            first_done = first.network.run_until(long_after(one), 3);
            second_done = second.network.run_until(long_after(other), 5);
        }
        EXPECT_EQ(first.network.fingerprint(), fingerprint_of(one));
        EXPECT_EQ(second.network.fingerprint(), fingerprint_of(other));
    }
}

// A node far away from all others draws from streams of its own, and so changes nothing for them.
TEST(Fingerprints, AFurtherNodeLeavesTheDrawsOfTheOthersUnchanged) {
    for (std::uint64_t seed = 20; seed < 30; ++seed) {
        const RandomScenario scenario = test::make_random_scenario(seed);
        RandomScenario with_guest = scenario;
        with_guest.nodes.push_back(silent_node({1e6, 0, 0}));
        ScenarioRun alone(scenario);
        ScenarioRun with(with_guest);
        with.network.node(static_cast<NodeId>(scenario.nodes.size())).set_protocol(nullptr);
        alone.network.run_until(long_after(scenario));
        with.network.run_until(long_after(scenario));
        EXPECT_TRUE(alone.deliveries == with.deliveries) << "scenario " << seed;
    }
}

}  // namespace
}  // namespace netsim
