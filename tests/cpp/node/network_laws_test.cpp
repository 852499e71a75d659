// Invariants of every network: outcomes balance, and runs are repeatable.
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <numeric>

#include <gtest/gtest.h>

#include "netsim/node/network.hpp"
#include "support/narrowband_scenario.hpp"
#include "support/random_interfaces.hpp"
#include "support/random_scenario.hpp"
#include "support/silent_node.hpp"

namespace netsim {
namespace {

using test::RandomScenario;
using test::ScenarioRun;
using test::silent_node;
using test::Talker;

SimTime s(double seconds) {
    return SimTime::from_seconds(seconds);
}

// Long after the last message: nothing is on the air or in a queue.
SimTime long_after(const RandomScenario& scenario) {
    return scenario.talk.until + s(60);
}

std::uint64_t sum_of(const auto& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

constexpr std::array all_frame_kinds{FrameKind::broadcast, FrameKind::unicast, FrameKind::ack, FrameKind::rts,
                                     FrameKind::cts};
constexpr std::array both_message_kinds{MessageKind::broadcast, MessageKind::unicast};

class Balance : public testing::TestWithParam<std::uint64_t> {
protected:
    // One of 802.11 stations, one with 802.15.4 devices, one of nodes with several interfaces.
    static std::array<RandomScenario, 3> scenarios() {
        return {test::make_random_scenario(GetParam()), test::make_narrowband_scenario(GetParam()),
                test::with_random_interfaces(test::make_random_scenario(GetParam()))};
    }
    static void expect_balance(const Network& network) {
        for (const FrameKind kind : all_frame_kinds) {
            for (const bool overheard : {false, true}) {
                EXPECT_EQ(sum_of(network.frame_outcomes().counts(kind, overheard)),
                          network.frame_outcomes().copies(kind, overheard));
            }
        }
        std::uint64_t census = 0;
        for (NodeId id = 0; id < network.node_count(); ++id) {
            for (const auto& interface : network.node(id).interfaces()) {
                expect_balance(interface->message_outcomes(), interface->queued_messages());
                census += interface->queued_messages();
            }
        }
        expect_balance(network.message_outcomes(), census);
    }
    // For one interface, or for all.
    static void expect_balance(const auto& message_outcomes, std::uint64_t census) {
        std::uint64_t queued = 0;
        for (const MessageKind kind : both_message_kinds) {
            const auto counts = message_outcomes.counts(kind);
            EXPECT_EQ(sum_of(counts), message_outcomes.accepted(kind));
            queued += counts[static_cast<std::size_t>(MessageOutcome::queued)];
        }
        EXPECT_EQ(queued, census);
    }
    // Each message is counted once, at an interface of its source node.
    static void expect_all_messages_accepted(Network& network) {
        for (NodeId id = 0; id < network.node_count(); ++id) {
            std::uint64_t accepted = 0;
            for (const auto& interface : network.node(id).interfaces()) {
                for (const MessageKind kind : both_message_kinds) {
                    accepted += interface->message_outcomes().accepted(kind);
                }
            }
            EXPECT_EQ(accepted, dynamic_cast<const Talker&>(*network.node(id).protocol()).sent());
        }
    }
    // Outcomes at the receivers, without those that are only kept as sums.
    static void expect_nodes_add_up(const Network& network) {
        for (const FrameKind kind : all_frame_kinds) {
            FrameOutcomes::Counts sums{};
            for (const bool overheard : {false, true}) {
                const auto counts = network.frame_outcomes().counts(kind, overheard);
                std::transform(sums.begin(), sums.end(), counts.begin(), sums.begin(), std::plus<>());
            }
            sums[static_cast<std::size_t>(FrameOutcome::below_sensitivity)] = 0;
            sums[static_cast<std::size_t>(FrameOutcome::in_air)] = 0;
            FrameOutcomes::Counts at_nodes{};
            for (NodeId id = 0; id < network.node_count(); ++id) {
                const auto counts = network.frame_outcomes().counts_at(id, kind);
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
            expect_all_messages_accepted(run.network);
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
                EXPECT_EQ(run.network.frame_outcomes().counts(
                              kind, overheard)[static_cast<std::size_t>(FrameOutcome::in_air)],
                          0U);
            }
        }
        for (const MessageKind kind : both_message_kinds) {
            EXPECT_EQ(
                run.network.message_outcomes().counts(kind)[static_cast<std::size_t>(MessageOutcome::queued)],
                0U);
        }
    }
}

TEST_P(Balance, AFrameOnTheAirIsAMessageOrAnAnswer) {
    const RandomScenario scenario = test::make_random_scenario(GetParam());
    ScenarioRun run(scenario);
    run.network.run_until(long_after(scenario));
    const FrameOutcomes& frames = run.network.frame_outcomes();
    const auto broadcasts = run.network.message_outcomes().counts(MessageKind::broadcast);
    EXPECT_EQ(frames.frames(FrameKind::broadcast),
              broadcasts[static_cast<std::size_t>(MessageOutcome::sent)]);
    const auto unicasts = frames.counts(FrameKind::unicast, false);
    EXPECT_EQ(frames.frames(FrameKind::ack), unicasts[static_cast<std::size_t>(FrameOutcome::delivered)]);
    const auto requests = frames.counts(FrameKind::rts, false);
    EXPECT_LE(frames.frames(FrameKind::cts), requests[static_cast<std::size_t>(FrameOutcome::delivered)]);
}

TEST(RandomScenario, AsksAndPermitsOften) {
    std::uint64_t requests = 0;
    std::uint64_t permissions = 0;
    for (std::uint64_t seed = 100'000; seed < 100'060; ++seed) {
        const RandomScenario scenario = test::make_random_scenario(seed);
        ScenarioRun run(scenario);
        run.network.run_until(long_after(scenario));
        requests += run.network.frame_outcomes().frames(FrameKind::rts);
        permissions += run.network.frame_outcomes().frames(FrameKind::cts);
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
    ++scenario.seed;  // the seed of the network; the protocols behave in the same way
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

// A distant node draws from its own streams, and does not affect others.
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
