#include "netsim/mobility/path_mobility.hpp"

#include <gtest/gtest.h>

#include "netsim/error.hpp"

namespace netsim {
namespace {

PathMobility around_an_area(double width_m, double speed_mps) {
    MobilityConfig config;
    config.type_name = "RectangleMobility";
    config.speed_mps = speed_mps;
    config.area_min = {0, 0, 0};
    config.area_max = {width_m, width_m, 0};
    return PathMobility(make_path(config, {}));
}

SimTime s(double seconds) {
    return SimTime::from_seconds(seconds);
}

TEST(PathMobility, EachLegEndsAtATurn) {
    PathMobility mobility = around_an_area(100, 10);
    EXPECT_EQ(mobility.begin_leg(s(0)), s(10));
    EXPECT_EQ(mobility.begin_leg(s(10)), s(20));
    EXPECT_EQ(mobility.trajectory().position_at(s(10)), (Position{100, 0, 0}));
    EXPECT_EQ(mobility.trajectory().position_at(s(15)), (Position{100, 50, 0}));
}

TEST(PathMobility, LegsTakeTimeAtAnySpeed) {
    PathMobility mobility = around_an_area(100, 1e12);
    const SimTime end = mobility.begin_leg(s(0));
    EXPECT_GE(end, SimTime::from_us(1));
    EXPECT_GE(mobility.begin_leg(end), end + SimTime::from_us(1));
}

TEST(PathMobility, StandsStillAtSpeedZero) {
    PathMobility mobility = around_an_area(100, 0);
    EXPECT_EQ(mobility.begin_leg(s(0)), SimTime::never());
    EXPECT_EQ(mobility.trajectory().position_at(s(100)), (Position{0, 0, 0}));
}

TEST(PathMobility, ItsLastLegEndsWithTheLongestRun) {
    PathMobility mobility = around_an_area(1e7, 1);
    const SimTime end = mobility.begin_leg(s(0));
    EXPECT_EQ(end, s(SimTime::longest_run_s));
    EXPECT_EQ(mobility.begin_leg(end), SimTime::never());
}

TEST(PathMobility, RefusesCommands) {
    PathMobility mobility = around_an_area(100, 10);
    EXPECT_FALSE(mobility.can_move());
    EXPECT_THROW(mobility.go_to(s(0), {1, 2, 3}), SimulationError);
    EXPECT_THROW(mobility.set_speed(s(0), 3), SimulationError);
}

}  // namespace
}  // namespace netsim
