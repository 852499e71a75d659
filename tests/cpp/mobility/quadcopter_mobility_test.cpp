#include "netsim/mobility/quadcopter_mobility.hpp"

#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "netsim/error.hpp"

namespace netsim {
namespace {

SimTime s(double seconds) {
    return SimTime::from_seconds(seconds);
}

QuadcopterMobility hovering() {
    return {{0, 0, 20}, 10, {.acceleration_mps2 = 2.5, .drag_kgps = 0.3}, Wind({}, 1, 0)};
}

TEST(QuadcopterMobility, EachFlightIsAStraightLeg) {
    QuadcopterMobility mobility = hovering();
    mobility.go_to(s(0), {100, 0, 20});
    for (int update = 0; update < 100; ++update) {
        mobility.fly(s(update * 0.01), s((update + 1) * 0.01));
    }
    const Trajectory& trajectory = mobility.trajectory();
    const Position middle = trajectory.position_at(s(0.995));
    const Position ends = trajectory.position_at(s(0.99)) + trajectory.position_at(s(1));
    EXPECT_NEAR(middle.x, ends.x / 2, 1e-9);
    EXPECT_GT(trajectory.speed_mps(s(0.995)), 1);
}

TEST(QuadcopterMobility, RefusesWhatNoVehicleCanDo) {
    QuadcopterMobility mobility = hovering();
    EXPECT_TRUE(mobility.can_move());
    EXPECT_THROW(mobility.go_to(s(0), {std::numeric_limits<double>::quiet_NaN(), 0, 0}), SimulationError);
    EXPECT_THROW(mobility.set_speed(s(0), -1), SimulationError);
}

TEST(QuadcopterMobility, TelemetryReportsTheErrorOfThePosition) {
    QuadcopterMobility mobility = hovering();
    EXPECT_EQ(mobility.reported_position(s(0)), (Position{0, 0, 20}));
    const GaussMarkov error(RandomStream(1, 0, Purpose::position_error), {1, 1, 1}, 30, 1);
    mobility.set_position_error(std::make_unique<GaussMarkov>(error));
    EXPECT_EQ(mobility.reported_position(s(2)), (Position{0, 0, 20} + GaussMarkov(error).at(2)));
    EXPECT_EQ(mobility.trajectory().position_at(s(2)), (Position{0, 0, 20}));
}

}  // namespace
}  // namespace netsim
