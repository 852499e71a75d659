#include "netsim/node/replay_recorder.hpp"

#include <cstring>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/node/network.hpp"
#include "support/random_scenario.hpp"
#include "support/recorder.hpp"

namespace netsim {
namespace {

using test::Recorder;
using test::ScenarioRun;

template <typename Value>
std::vector<Value> values(const ReplayChunk& chunk, const std::string& table, const std::string& column,
                          bool delta = false) {
    for (const ReplayChunk::Table& candidate : chunk.tables) {
        for (const ReplayChunk::Column& found : candidate.columns) {
            if (candidate.name == table && found.name == column) {
                std::vector<Value> result(found.octets.size() / sizeof(Value));
                std::memcpy(result.data(), found.octets.data(), found.octets.size());
                for (std::size_t row = 1; delta && row < result.size(); ++row) {
                    result[row] = static_cast<Value>(result[row] + result[row - 1]);
                }
                return result;
            }
        }
    }
    ADD_FAILURE() << "no column " << column << " in " << table;
    return {};
}

constexpr int below_sensitivity = static_cast<int>(FrameFate::below_sensitivity);

// {(receiver, outcome): receptions}, from the changes. Those below the sensitivity are left out: the
// network counts them per frame.
using Counts = std::map<std::tuple<std::uint32_t, int>, std::uint64_t>;

Counts counts_of(const std::vector<ReplayChunk>& chunks) {
    Counts counts;
    for (const ReplayChunk& chunk : chunks) {
        const auto senders = values<std::uint32_t>(chunk, "frames", "node");
        const auto interfaces = values<std::uint8_t>(chunk, "frames", "interface");
        const auto frames = values<std::uint32_t>(chunk, "receptions", "frame", true);
        const auto receivers = values<std::uint32_t>(chunk, "receptions", "receiver");
        const auto outcomes = values<std::uint8_t>(chunk, "receptions", "outcome");
        std::map<std::pair<std::uint32_t, std::uint8_t>, std::map<std::uint32_t, int>> heard_by;
        std::size_t change = 0;
        for (std::uint32_t frame = 0; frame < senders.size(); ++frame) {
            auto& heard = heard_by[{senders[frame], interfaces[frame]}];
            for (; change < frames.size() && frames[change] == frame; ++change) {
                if (outcomes[change] == 255) {
                    heard.erase(receivers[change]);
                } else {
                    heard[receivers[change]] = outcomes[change];
                }
            }
            for (const auto& [receiver, outcome] : heard) {
                if (outcome != below_sensitivity) {
                    ++counts[{receiver, outcome}];
                }
            }
        }
    }
    return counts;
}

class RecordedScenario : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RecordedScenario, HasTheReceptionsOfTheLedgerAndIsTheSameRun) {
    const test::RandomScenario scenario = test::make_random_scenario(GetParam());
    const SimTime end = scenario.talk.until + SimTime::from_seconds(60);
    ScenarioRun plain(scenario);
    plain.network.run_until(end);
    ScenarioRun run(scenario, Culling::enabled, true);
    run.network.run_until(end);
    EXPECT_EQ(run.network.fingerprint(), plain.network.fingerprint());
    run.recorder->finish();
    Counts expected;
    for (NodeId id = 0; id < run.network.node_count(); ++id) {
        for (std::size_t kind = 0; kind < frame_kind_count; ++kind) {
            const auto counts = run.network.frame_fates().counts_at(id, static_cast<FrameKind>(kind));
            for (std::size_t fate = 0; fate < frame_fate_count; ++fate) {
                if (counts[fate] > 0) {
                    expected[{static_cast<std::uint32_t>(id), static_cast<int>(fate)}] += counts[fate];
                }
            }
        }
    }
    const std::vector<ReplayChunk> chunks = run.recorder->take();
    EXPECT_EQ(counts_of(chunks), expected);
    Counts told;
    for (const ReplayChunk& chunk : chunks) {
        for (const ReplayChunk::Outcome& outcome : chunk.outcomes) {
            if (outcome.fate == FrameFate::below_sensitivity) {
                continue;
            }
            told[{static_cast<std::uint32_t>(outcome.node), static_cast<int>(outcome.fate)}] += outcome.count;
        }
    }
    EXPECT_EQ(told, expected);
}

INSTANTIATE_TEST_SUITE_P(Random, RecordedScenario, testing::Range<std::uint64_t>(0, 12));

TEST(ReplayRecorder, AMovingNodeInAChunkThatBeginsOnItsWay) {
    Network network{MediumConfig(), 1};
    NodeConfig config("node");
    config.mobility.telemetry_interval_s = 0;
    Recorder& flown = test::add_recorder(network, config);
    flown.on_initialize = [](Recorder& self) {
        self.node.set_speed(1);
        self.node.go_to({100, 0, 0});
    };
    ReplayRecorder& recorder = network.record({0});
    network.initialize();
    network.schedule(SimTime::from_seconds(61), [&] { flown.node.set_speed(2); });
    network.run_until(SimTime::from_seconds(70));
    recorder.finish();
    const std::vector<ReplayChunk> chunks = recorder.take();
    ASSERT_EQ(chunks.size(), 2U);
    // The current leg, and the one that the command started.
    EXPECT_EQ(values<std::uint64_t>(chunks[1], "legs", "time_ns"),
              (std::vector<std::uint64_t>{61'000'000'000, 61'000'000'000}));
    EXPECT_EQ(values<double>(chunks[1], "legs", "x1").back(), 100);
    EXPECT_EQ(values<double>(chunks[1], "legs", "x0").back(), 61);
    EXPECT_EQ(chunks[1].start, chunks[0].end);
}

TEST(ReplayRecorder, ANodeThatIsNotRecordedHasAPathOnly) {
    Network network{MediumConfig(), 1};
    NodeConfig config("node");
    config.mobility.telemetry_interval_s = 0;
    for (const double x : {0.0, 10.0, 20.0}) {
        config.initial_position = {x, 0, 0};
        Recorder& talker = test::add_recorder(network, config);
        talker.on_initialize = [](Recorder& self) {
            self.node.schedule_timer("talk", SimTime::from_us(std::int64_t{1000} * self.node.id()));
        };
        talker.on_timer = [](Recorder& self, const std::string&) { self.broadcast("hello"); };
    }
    ReplayRecorder& recorder = network.record({2});
    network.initialize();
    network.run_until(SimTime::from_seconds(1));
    recorder.finish();
    const std::vector<ReplayChunk> chunks = recorder.take();
    ASSERT_EQ(chunks.size(), 1U);
    EXPECT_EQ(counts_of(chunks), (Counts{{{0, 0}, 1}, {{1, 0}, 1}, {{2, 0}, 2}}));
    EXPECT_EQ(values<std::uint32_t>(chunks[0], "events", "node"), (std::vector<std::uint32_t>{2}));
    EXPECT_EQ(values<std::uint32_t>(chunks[0], "legs", "node"), (std::vector<std::uint32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace netsim
