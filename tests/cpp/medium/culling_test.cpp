// With culling, the medium notifies radios of relevant arrivals only. A run must still match the
// plain model, in which every radio is notified of all: the same frames at the same instants, and
// the same copies lost for the same reasons.
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/far_flung_scenario.hpp"
#include "support/light_step_scenario.hpp"
#include "support/narrowband_scenario.hpp"
#include "support/random_environment.hpp"
#include "support/random_interfaces.hpp"
#include "support/random_path_loss.hpp"
#include "support/random_receivers.hpp"
#include "support/random_scenario.hpp"

namespace netsim {
namespace {

using test::RandomScenario;
using test::ScenarioRun;

struct Ledger {
    std::vector<std::uint64_t> counts;
    std::vector<std::map<NodeId, std::uint64_t>> interferers;

    bool operator==(const Ledger&) const = default;
};

template <typename Counts>
void append(std::vector<std::uint64_t>& all, const Counts& counts) {
    all.insert(all.end(), counts.begin(), counts.end());
}

template <typename Counts>
void add(Counts& sums, const Counts& counts) {
    std::transform(sums.begin(), sums.end(), counts.begin(), sums.begin(), std::plus<>());
}

Ledger ledger_of(const Network& network) {
    Ledger ledger;
    const FrameOutcomes& frames = network.frame_outcomes();
    for (std::size_t i = 0; i < frame_kind_count; ++i) {
        const auto kind = static_cast<FrameKind>(i);
        ledger.counts.push_back(frames.frames(kind));
        append(ledger.counts, frames.counts(kind, false));
        append(ledger.counts, frames.counts(kind, true));
        for (NodeId node = 0; node < network.node_count(); ++node) {
            append(ledger.counts, frames.counts_at(node, kind));
        }
    }
    for (const MessageKind kind : {MessageKind::broadcast, MessageKind::unicast}) {
        append(ledger.counts, network.message_outcomes().counts(kind));
    }
    for (NodeId node = 0; node < network.node_count(); ++node) {
        ledger.interferers.push_back(frames.interferers_at(node));
    }
    return ledger;
}

std::uint64_t frame_count(const Network& network) {
    std::uint64_t count = 0;
    for (std::size_t kind = 0; kind < frame_kind_count; ++kind) {
        count += network.frame_outcomes().frames(static_cast<FrameKind>(kind));
    }
    return count;
}

// Runs both models step by step, to find the step in which they differ.
void expect_same_course(const RandomScenario& scenario) {
    ScenarioRun shortcut(scenario, Culling::enabled);
    ScenarioRun plain(scenario, Culling::disabled);
    constexpr int steps = 200;
    const SimTime end = SimTime::from_seconds(scenario.talk.until.seconds() * 2);
    for (int step = 1; step <= steps; ++step) {
        const SimTime limit = SimTime::from_ps(end.ps() / steps * step);
        shortcut.network.run_until(limit);
        plain.network.run_until(limit);
        ASSERT_EQ(shortcut.network.fingerprint(), plain.network.fingerprint())
            << "scenario " << scenario.seed << ", before " << limit.ps() << " ps";
        ASSERT_EQ(shortcut.deliveries.size(), plain.deliveries.size()) << "scenario " << scenario.seed;
    }
    EXPECT_TRUE(shortcut.deliveries == plain.deliveries) << "scenario " << scenario.seed;
    EXPECT_EQ(ledger_of(shortcut.network), ledger_of(plain.network)) << "scenario " << scenario.seed;
    // One more event for an instant at which five or more frames begin, and for a deferred
    // evaluation, which usually saves four or more notifications.
    const std::uint64_t more = frame_count(plain.network) / 5 + plain.network.event_count() / 50;
    EXPECT_LE(shortcut.network.event_count(), plain.network.event_count() + more)
        << "scenario " << scenario.seed;
}

// Multiplies the number of scenarios, to test changes of the medium. `make test` has to be fast.
std::uint64_t thoroughness() {
    const char* factor =
        std::getenv("NETSIM_THOROUGHNESS");  // NOLINT(concurrency-mt-unsafe): no thread sets it
    return factor == nullptr ? 1 : std::max(std::strtoull(factor, nullptr, 10), 1ULL);
}

// The scenarios of one batch. make(seed) creates one.
template <typename Make>
void expect_same_courses(std::uint64_t batch, std::uint64_t count, const Make& make) {
    const std::uint64_t scenarios = count * thoroughness();
    for (std::uint64_t i = 0; i < scenarios; ++i) {
        expect_same_course(make(batch * scenarios + i));
        if (testing::Test::HasFatalFailure()) {
            return;
        }
    }
}

class RandomScenarios : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomScenarios, MatchThePlainModel) {
    expect_same_courses(GetParam(), 5, [](std::uint64_t seed) { return test::make_random_scenario(seed); });
}

TEST_P(RandomScenarios, MatchThePlainModelForAnyPathLoss) {
    expect_same_courses(GetParam(), 5, [](std::uint64_t seed) {
        return test::with_random_path_loss(test::make_random_scenario(seed));
    });
}

TEST_P(RandomScenarios, MatchThePlainModelWithQuadcoptersInAStorm) {
    expect_same_courses(GetParam(), 3, [](std::uint64_t seed) {
        RandomScenario scenario = test::make_random_scenario(seed);
        for (NodeConfig& node : scenario.nodes) {
            node.mobility.type_name = "QuadcopterMobility";
            node.initial_position.z += 20;
            node.wind = {.speed_mps = 60, .gusts_mps = 20, .gust_time_s = 0.1};
        }
        scenario.talk.moves = true;
        return scenario;
    });
}

TEST_P(RandomScenarios, MatchThePlainModelWithAntennasAndObstacles) {
    expect_same_courses(GetParam(), 5, [](std::uint64_t seed) {
        const RandomScenario scenario = test::with_random_environment(test::make_random_scenario(seed));
        return seed % 4 == 0 ? test::with_random_path_loss(scenario) : scenario;
    });
}

TEST_P(RandomScenarios, MatchThePlainModelWithInterfacesOnOverlappingChannels) {
    expect_same_courses(GetParam(), 3, [](std::uint64_t seed) {
        const RandomScenario scenario = test::with_random_interfaces(test::make_random_scenario(seed));
        return seed % 4 == 0 ? test::with_random_environment(test::with_random_path_loss(scenario))
                             : scenario;
    });
}

class LightStepScenarios : public testing::TestWithParam<std::uint64_t> {};

TEST_P(LightStepScenarios, MatchThePlainModel) {
    expect_same_courses(GetParam(), 3, test::make_light_step_scenario);
}

class FarFlungScenarios : public testing::TestWithParam<std::uint64_t> {};

TEST_P(FarFlungScenarios, MatchThePlainModel) {
    expect_same_courses(GetParam(), 2, test::make_far_flung_scenario);
}

TEST_P(FarFlungScenarios, MatchThePlainModelForAnyPathLoss) {
    expect_same_courses(GetParam(), 1, [](std::uint64_t seed) {
        return test::with_random_path_loss(test::make_far_flung_scenario(seed));
    });
}

TEST_P(FarFlungScenarios, MatchThePlainModelWithAntennasAndObstacles) {
    expect_same_courses(GetParam(), 1, [](std::uint64_t seed) {
        return test::with_random_environment(test::make_far_flung_scenario(seed));
    });
}

TEST_P(FarFlungScenarios, MatchThePlainModelWithInterfacesOnOverlappingChannels) {
    expect_same_courses(GetParam(), 1, [](std::uint64_t seed) {
        return test::with_random_interfaces(test::make_far_flung_scenario(seed));
    });
}

TEST_P(FarFlungScenarios, MatchThePlainModelWithReceiverOptions) {
    expect_same_courses(GetParam(), 1, [](std::uint64_t seed) {
        return test::with_random_receivers(test::make_far_flung_scenario(seed));
    });
}

class NarrowbandScenarios : public testing::TestWithParam<std::uint64_t> {};

TEST_P(NarrowbandScenarios, MatchThePlainModel) {
    expect_same_courses(GetParam(), 5, test::make_narrowband_scenario);
}

TEST(NarrowbandScenario, CoversEveryOutcome) {
    FrameOutcomes::Counts frames{};
    MessageOutcomes::Counts messages{};
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const RandomScenario scenario = test::make_narrowband_scenario(seed);
        ScenarioRun run(scenario);
        run.network.run_until(scenario.talk.until);
        for (const FrameKind kind : {FrameKind::broadcast, FrameKind::unicast, FrameKind::ack}) {
            add(frames, run.network.frame_outcomes().counts(kind, false));
        }
        for (const MessageKind kind : {MessageKind::broadcast, MessageKind::unicast}) {
            add(messages, run.network.message_outcomes().counts(kind));
        }
    }
    for (std::size_t outcome = 0; outcome < frame_outcome_count; ++outcome) {
        EXPECT_GE(frames[outcome], 30U) << frame_outcome_names[outcome];
    }
    for (std::size_t outcome = 0; outcome < message_outcome_count; ++outcome) {
        if (static_cast<MessageOutcome>(outcome) !=
            MessageOutcome::out_of_range) {  // of perfect channels only
            EXPECT_GE(messages[outcome], 30U) << message_outcome_names[outcome];
        }
    }
}

TEST(RandomScenario, CoversEveryOutcome) {
    FrameOutcomes::Counts frames{};
    MessageOutcomes::Counts messages{};
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const RandomScenario scenario = test::make_random_scenario(seed);
        ScenarioRun run(scenario);
        run.network.run_until(SimTime::from_ps(scenario.talk.until.ps() / 2));
        for (const FrameKind kind : {FrameKind::broadcast, FrameKind::unicast, FrameKind::ack}) {
            add(frames, run.network.frame_outcomes().counts(kind, false));
            add(frames, run.network.frame_outcomes().counts(kind, true));
        }
        for (const MessageKind kind : {MessageKind::broadcast, MessageKind::unicast}) {
            add(messages, run.network.message_outcomes().counts(kind));
        }
    }
    for (std::size_t outcome = 0; outcome < frame_outcome_count; ++outcome) {
        EXPECT_GE(frames[outcome], 30U) << frame_outcome_names[outcome];
    }
    for (std::size_t outcome = 0; outcome < message_outcome_count; ++outcome) {
        // Outcomes of perfect channels and of 802.15.4 only.
        if (static_cast<MessageOutcome>(outcome) != MessageOutcome::out_of_range &&
            static_cast<MessageOutcome>(outcome) != MessageOutcome::channel_access_failure) {
            EXPECT_GE(messages[outcome], 30U) << message_outcome_names[outcome];
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Batches, RandomScenarios, testing::Range<std::uint64_t>(0, 10));
INSTANTIATE_TEST_SUITE_P(Batches, LightStepScenarios, testing::Range<std::uint64_t>(0, 10));
INSTANTIATE_TEST_SUITE_P(Batches, NarrowbandScenarios, testing::Range<std::uint64_t>(0, 10));
INSTANTIATE_TEST_SUITE_P(Batches, FarFlungScenarios, testing::Range<std::uint64_t>(0, 10));

}  // namespace
}  // namespace netsim
