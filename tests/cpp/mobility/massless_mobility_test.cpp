#include "netsim/mobility/massless_mobility.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "netsim/error.hpp"

namespace netsim {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

SimTime s(double seconds) {
    return SimTime::from_seconds(seconds);
}

TEST(MasslessMobility, FliesAtItsFirstSpeed) {
    MasslessMobility mobility({0, 0, 0}, 4);
    mobility.go_to(s(0), {100, 0, 0});
    EXPECT_NEAR(mobility.trajectory().position_at(s(5)).x, 20, 1e-9);
}

TEST(MasslessMobility, ANewSpeedHoldsAlsoOnThePresentLeg) {
    MasslessMobility mobility({0, 0, 0}, 4);
    mobility.go_to(s(0), {100, 0, 0});
    mobility.set_speed(s(5), 40);
    EXPECT_NEAR(mobility.trajectory().position_at(s(6)).x, 60, 1e-9);
    EXPECT_NEAR(mobility.trajectory().position_at(s(60)).x, 100, 1e-9);
}

TEST(MasslessMobility, ASpeedBeforeTheFirstTargetHoldsOnTheFirstLeg) {
    MasslessMobility mobility({0, 0, 0}, 4);
    mobility.set_speed(s(0), 7);
    EXPECT_EQ(mobility.trajectory().position_at(s(10)), (Position{0, 0, 0}));
    mobility.go_to(s(10), {100, 0, 0});
    EXPECT_NEAR(mobility.trajectory().position_at(s(11)).x, 7, 1e-9);
}

TEST(MasslessMobility, SpeedZeroIsAPause) {
    MasslessMobility mobility({0, 0, 0}, 10);
    mobility.go_to(s(0), {100, 0, 0});
    mobility.set_speed(s(3), 0);
    EXPECT_NEAR(mobility.trajectory().position_at(s(50)).x, 30, 1e-9);
    mobility.set_speed(s(50), 10);
    EXPECT_NEAR(mobility.trajectory().position_at(s(51)).x, 40, 1e-9);
}

TEST(MasslessMobility, ANewSpeedAtTheTargetMovesNothing) {
    MasslessMobility mobility({0, 0, 0}, 10);
    mobility.go_to(s(0), {100, 0, 0});
    mobility.set_speed(s(20), 3);
    EXPECT_EQ(mobility.trajectory().position_at(s(30)), (Position{100, 0, 0}));
}

TEST(MasslessMobility, RefusesTargetsThatAreNotFinite) {
    MasslessMobility mobility({0, 0, 0}, 10);
    EXPECT_THROW(mobility.go_to(s(0), {not_a_number, 0, 0}), SimulationError);
    EXPECT_THROW(mobility.go_to(s(0), {0, infinity, 0}), SimulationError);
    EXPECT_THROW(mobility.go_to(s(0), {0, 0, -infinity}), SimulationError);
}

TEST(MasslessMobility, RefusesSpeedsThatAreNone) {
    MasslessMobility mobility({0, 0, 0}, 10);
    for (const double speed_mps : {not_a_number, infinity, -1.0}) {
        EXPECT_THROW(mobility.set_speed(s(0), speed_mps), SimulationError) << speed_mps;
    }
}

TEST(MasslessMobility, ARefusedCommandChangesNothing) {
    MasslessMobility mobility({0, 0, 0}, 10);
    mobility.go_to(s(0), {100, 0, 0});
    EXPECT_THROW(mobility.go_to(s(1), {infinity, 0, 0}), SimulationError);
    EXPECT_THROW(mobility.set_speed(s(1), -5), SimulationError);
    EXPECT_NEAR(mobility.trajectory().position_at(s(2)).x, 20, 1e-9);
}

TEST(MasslessMobility, TheErrorNamesTheSpeed) {
    MasslessMobility mobility({0, 0, 0}, 10);
    try {
        mobility.set_speed(s(0), -2);
        FAIL() << "no error";
    } catch (const SimulationError& error) {
        EXPECT_EQ(std::string(error.what()),
                  "cannot fly at -2.000000 m/s: expected a finite speed of at least 0 m/s");
    }
}

}  // namespace
}  // namespace netsim
