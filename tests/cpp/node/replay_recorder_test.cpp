#include "netsim/node/replay_recorder.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
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

constexpr int below_sensitivity = static_cast<int>(FrameOutcome::below_sensitivity);

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
            const auto counts = run.network.frame_outcomes().counts_at(id, static_cast<FrameKind>(kind));
            for (std::size_t outcome = 0; outcome < frame_outcome_count; ++outcome) {
                if (counts[outcome] > 0) {
                    expected[{static_cast<std::uint32_t>(id), static_cast<int>(outcome)}] += counts[outcome];
                }
            }
        }
    }
    const std::vector<ReplayChunk> chunks = run.recorder->take();
    EXPECT_EQ(counts_of(chunks), expected);
    Counts told;
    for (const ReplayChunk& chunk : chunks) {
        for (const ReplayChunk::OutcomeCount& of_node : chunk.outcomes) {
            if (of_node.outcome == FrameOutcome::below_sensitivity) {
                continue;
            }
            told[{static_cast<std::uint32_t>(of_node.node), static_cast<int>(of_node.outcome)}] +=
                of_node.count;
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

// The first node sends at 1 ms: to node `destination`, or to all.
std::vector<ReplayChunk> record(const MediumConfig& medium, const std::vector<Position>& places,
                                const std::vector<std::string>& messages, NodeId destination = broadcast_id) {
    Network network{medium, 1};
    NodeConfig config("node");
    config.mobility.telemetry_interval_s = 0;
    config.wlan[0].radio.communication_range_m = 100;  // of the unit disk medium
    std::vector<NodeId> all;
    for (const Position& place : places) {
        config.initial_position = place;
        Recorder& node = test::add_recorder(network, config);
        if (all.empty()) {
            node.on_initialize = [](Recorder& self) {
                self.node.schedule_timer("talk", SimTime::from_us(1000));
            };
            node.on_timer = [&](Recorder& self, const std::string&) {
                for (const std::string& message : messages) {
                    if (destination == broadcast_id) {
                        self.broadcast(message);
                    } else {
                        self.send(destination, message);
                    }
                }
            };
        }
        all.push_back(static_cast<NodeId>(all.size()));
    }
    ReplayRecorder& recorder = network.record(all);
    network.initialize();
    network.run_until(SimTime::from_seconds(1));
    recorder.finish();
    return recorder.take();
}

MediumConfig behind_a_wall(const char* obstacle_loss) {
    ObstacleConfig wall;
    wall.rings = {{{10, -500}, {10.2, -500}, {10.2, 500}, {10, 500}}};
    wall.top_m = 20;
    wall.material = "brick";
    MediumConfig medium;
    medium.obstacle_loss = obstacle_loss;
    medium.obstacles = {wall};
    return medium;
}

constexpr std::int16_t no_power = -32768;

TEST(ReplayRecorder, SaysWhatTookThePowerOfAFrame) {
    const auto chunks = record(behind_a_wall("IdealObstacleLoss"),
                               {{0, 0, 2}, {5, 0, 2}, {50, 0, 2}, {90000, 0, 2}}, {"hello"});
    ASSERT_EQ(chunks.size(), 1U);
    const auto& chunk = chunks[0];
    // Node 3 is too far away, whatever is in between.
    EXPECT_EQ(values<std::uint32_t>(chunk, "losses", "receiver"), (std::vector<std::uint32_t>{2}));
    EXPECT_EQ(values<std::int16_t>(chunk, "losses", "power_cdbm"), (std::vector<std::int16_t>{no_power}));
    EXPECT_EQ(values<std::int16_t>(chunk, "losses", "noise_cdbm"), (std::vector<std::int16_t>{no_power}));
    EXPECT_EQ(values<std::int16_t>(chunk, "losses", "needed_cdb"), (std::vector<std::int16_t>{-8500}));
    EXPECT_EQ(values<std::int16_t>(chunk, "losses", "distance_cdb"), (std::vector<std::int16_t>{-7407}));
    EXPECT_EQ(values<std::uint32_t>(chunk, "obstructions", "obstacle"), (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(values<std::uint32_t>(chunk, "frames", "unnoticed"), (std::vector<std::uint32_t>{2}));
    EXPECT_EQ(values<std::uint32_t>(chunk, "frames", "receptions"), (std::vector<std::uint32_t>{1}));
    EXPECT_EQ(values<std::uint8_t>(chunk, "receptions", "outcome"), (std::vector<std::uint8_t>{0, 1}));
}

TEST(ReplayRecorder, ExplainsTheLossAtTheDestinationAtAnyDistance) {
    const auto chunks = record(MediumConfig(), {{0, 0, 2}, {90000, 0, 2}, {90000, 9, 2}}, {"hello"}, 1);
    const auto receivers = values<std::uint32_t>(chunks.at(0), "losses", "receiver");
    EXPECT_EQ(receivers.size(), values<std::uint32_t>(chunks[0], "frames", "node").size());
    EXPECT_EQ(std::set<std::uint32_t>(receivers.begin(), receivers.end()), (std::set<std::uint32_t>{1}));
}

TEST(ReplayRecorder, KeepsTheFiftyStrongestLossesOfAFrame) {
    MediumConfig medium = behind_a_wall("DielectricObstacleLoss");
    medium.obstacles[0].material = "concrete";
    medium.obstacles[0].rings = {{{10, -500}, {12, -500}, {12, 500}, {10, 500}}};
    std::vector<Position> places{{0, 0, 2}};
    for (int node = 0; node < 60; ++node) {
        places.push_back({100.0 - node, 0, 2});
    }
    const auto chunks = record(medium, places, {"hello"});
    auto receivers = values<std::uint32_t>(chunks.at(0), "losses", "receiver");
    std::ranges::sort(receivers);
    ASSERT_EQ(receivers.size(), 50U);
    EXPECT_EQ(receivers.front(), 11U);  // those before it are farther away
    EXPECT_EQ(values<std::uint32_t>(chunks[0], "frames", "unnoticed"), (std::vector<std::uint32_t>{60}));
}

TEST(ReplayRecorder, KeepsEachMessageOnce) {
    const auto chunks = record(MediumConfig(), {{0, 0, 2}, {5, 0, 2}}, {"hello", "you", "hello"});
    EXPECT_EQ(values<std::uint32_t>(chunks.at(0), "frames", "text"), (std::vector<std::uint32_t>{1, 2, 1}));
    EXPECT_EQ(values<std::uint32_t>(chunks[0], "texts", "bytes"), (std::vector<std::uint32_t>{5, 3}));
    const auto octets = values<char>(chunks[0], "text_bytes", "byte");
    EXPECT_EQ(std::string(octets.begin(), octets.end()), "helloyou");
}

TEST(ReplayRecorder, CutsLongMessagesBetweenCharacters) {
    const MediumConfig unit_disk{std::string(unit_disk_medium)};
    std::string umlauts = "x";
    while (umlauts.size() < 5000) {
        umlauts += "\u00fc";
    }
    const auto chunks = record(unit_disk, {{0, 0, 2}, {5, 0, 2}}, {umlauts});
    EXPECT_EQ(values<std::uint32_t>(chunks.at(0), "texts", "recorded"), (std::vector<std::uint32_t>{1999}));
    EXPECT_EQ(values<std::uint32_t>(chunks[0], "texts", "bytes"), (std::vector<std::uint32_t>{5001}));
}

TEST(ReplayRecorder, LeavesOutTextsOnceAChunkHasManyOfThem) {
    std::vector<std::string> messages;
    for (int number = 0; number < 600; ++number) {
        messages.push_back(std::to_string(number) + std::string(1000, 'x'));
    }
    const MediumConfig unit_disk{std::string(unit_disk_medium)};
    const auto chunks = record(unit_disk, {{0, 0, 2}, {5, 0, 2}}, messages);
    const auto texts = values<std::uint32_t>(chunks.at(0), "frames", "text");
    ASSERT_EQ(texts.size(), 600U);
    EXPECT_EQ(texts[498], 499U);
    EXPECT_EQ(texts[499], 0xFFFFFFFF);
    EXPECT_EQ(texts.back(), 0xFFFFFFFF);
}

}  // namespace
}  // namespace netsim
