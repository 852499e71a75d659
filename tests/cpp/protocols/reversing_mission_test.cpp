#include "protocols/reversing_mission.hpp"

#include <gtest/gtest.h>

#include "netsim/node/network.hpp"

namespace netsim {
namespace {

// Flies along the x axis at 10 m/s; the test sets its position.
class ReversingMissionTest : public testing::Test {
protected:
    double target_x_after(const Position& telemetry) {
        mission.handle_telemetry(telemetry);
        return node.trajectory().position_at(SimTime::from_seconds(1e6)).x;
    }

    Network network{MediumConfig(), 1};
    Node& node = network.add_node(NodeConfig("uav"));
    ReversingMission mission{node, 10};
};

TEST_F(ReversingMissionTest, FliesToAndFro) {
    mission.start({{0, 0, 0}, {100, 0, 0}, {200, 0, 0}});
    EXPECT_EQ(target_x_after({0, 0, 0}), 100);
    EXPECT_EQ(target_x_after({100, 0, 0.5}), 200);
    EXPECT_FALSE(mission.is_reversed());
    EXPECT_EQ(target_x_after({200, 0, 0}), 100);
    EXPECT_TRUE(mission.is_reversed());
    EXPECT_EQ(target_x_after({100, 0, 0}), 0);
    EXPECT_EQ(target_x_after({0, 0, 0}), 100);
    EXPECT_FALSE(mission.is_reversed());
}

TEST_F(ReversingMissionTest, OutsideOfTheToleranceItFliesOn) {
    mission.start({{50, 0, 0}, {100, 0, 0}});
    EXPECT_EQ(target_x_after({50.6, 0, 0}), 50);
}

TEST_F(ReversingMissionTest, TurnsRoundOnce) {
    mission.start({{10, 0, 0}, {100, 0, 0}, {200, 0, 0}});
    EXPECT_EQ(target_x_after({10, 0, 0}), 100);
    mission.set_reversed(true);
    mission.set_reversed(true);
    EXPECT_EQ(target_x_after({50, 0, 0}), 10);
    mission.set_reversed(false);
    EXPECT_EQ(target_x_after({50, 0, 0}), 100);
}

TEST_F(ReversingMissionTest, TurnedRoundAtAnEndItStaysThere) {
    mission.start({{10, 0, 0}, {100, 0, 0}});
    mission.set_reversed(true);
    EXPECT_EQ(target_x_after({5, 0, 0}), 10);
}

TEST_F(ReversingMissionTest, TheOnlyWaypointIsKept) {
    mission.start({{10, 0, 0}});
    EXPECT_EQ(target_x_after({10, 0, 0}), 10);
    EXPECT_EQ(target_x_after({10, 0, 0}), 10);
}

TEST_F(ReversingMissionTest, IsIdleUntilItStarts) {
    EXPECT_TRUE(mission.is_idle());
    EXPECT_EQ(target_x_after({0, 0, 0}), 0);
}

}  // namespace
}  // namespace netsim
