#include "netsim/node/telemetry_clock.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/recorder.hpp"

namespace netsim {
namespace {

using test::Recorder;

SimTime s(double seconds) {
    return SimTime::from_seconds(seconds);
}

class TelemetryClockTest : public testing::Test {
protected:
    Recorder& add_node(double interval_s, Position position = {}) {
        NodeConfig config("node");
        config.initial_position = position;
        config.mobility.telemetry_interval_s = interval_s;
        return test::add_recorder(network, config);
    }
    void run(double seconds) {
        network.initialize();
        network.run_until(s(seconds));
    }

    Network network{MediumConfig(), 1};
};

TEST_F(TelemetryClockTest, TicksAtEveryMultipleOfTheInterval) {
    const Recorder& recorder = add_node(0.5);
    run(2);
    EXPECT_EQ(recorder.telemetry_times, (std::vector{s(0.5), s(1), s(1.5), s(2)}));
}

TEST_F(TelemetryClockTest, DoesNotDrift) {
    const Recorder& recorder = add_node(0.1);
    run(100);
    EXPECT_EQ(recorder.telemetry_times.size(), 1000U);
    EXPECT_EQ(recorder.telemetry_times.back(), s(100));
}

TEST_F(TelemetryClockTest, EndsWithTheLongestRun) {
    const Recorder& recorder = add_node(1e6);
    run(SimTime::longest_run_s);
    EXPECT_EQ(recorder.telemetry_times.size(), 9U);
    EXPECT_EQ(network.pending_count(), 0U);
}

TEST_F(TelemetryClockTest, GivesEachNodeItsOwnPosition) {
    const Recorder& standing = add_node(1, {5, 6, 7});
    Recorder& moving = add_node(1);
    moving.node.set_speed(3);
    moving.node.go_to({100, 0, 0});
    run(2);
    EXPECT_EQ(standing.telemetry, (std::vector<Position>{{5, 6, 7}, {5, 6, 7}}));
    ASSERT_EQ(moving.telemetry.size(), 2U);
    EXPECT_NEAR(moving.telemetry[0].x, 3, 1e-9);
    EXPECT_NEAR(moving.telemetry[1].x, 6, 1e-9);
}

TEST_F(TelemetryClockTest, GoesInTheOrderOfIds) {
    std::vector<NodeId> order;
    for (int i = 0; i < 3; ++i) {
        add_node(1).on_telemetry = [&order](Recorder& self) { order.push_back(self.node.id()); };
    }
    run(1);
    EXPECT_EQ(order, (std::vector<NodeId>{0, 1, 2}));
}

TEST_F(TelemetryClockTest, ComesAfterTheTimersOfItsInstant) {
    std::string order;
    Recorder& recorder = add_node(0.25);
    recorder.on_timer = [&order](Recorder&, const std::string&) { order += 't'; };
    recorder.on_telemetry = [&order](Recorder& self) {
        order += 'p';
        if (self.node.now() == s(0.25)) {
            self.node.schedule_timer("", s(0.5));
        }
    };
    run(0.5);
    EXPECT_EQ(order, "ptp");
}

TEST_F(TelemetryClockTest, NodesOfOneIntervalShareTheirEvents) {
    for (int i = 0; i < 10; ++i) {
        add_node(0.1);
    }
    run(1);
    EXPECT_EQ(network.event_count(), 20U);  // a tick and its telemetry each
}

TEST_F(TelemetryClockTest, IntervalsAreKeptApart) {
    const Recorder& slow = add_node(1);
    const Recorder& quick = add_node(0.25);
    const Recorder& none = add_node(0);
    run(1);
    EXPECT_EQ(slow.telemetry.size(), 1U);
    EXPECT_EQ(quick.telemetry.size(), 4U);
    EXPECT_TRUE(none.telemetry.empty());
}

TEST_F(TelemetryClockTest, ANodeWithoutAProtocolIsPassedOver) {
    add_node(1);
    const Recorder& recorder = add_node(1);
    network.node(0).set_protocol(nullptr);
    run(1);
    EXPECT_EQ(recorder.telemetry.size(), 1U);
}

}  // namespace
}  // namespace netsim
