#include "netsim/medium/odometer.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

SimTime s(double seconds) {
    return SimTime::from_seconds(seconds);
}

TEST(Odometer, StandsWhileAllStand) {
    const Trajectory place({1, 2, 3});
    Odometer odometer;
    odometer.watch(place, s(0));
    EXPECT_TRUE(odometer.all_stand());
    EXPECT_EQ(odometer.reading_m(s(1000)), odometer.reading_m(s(0)));
}

TEST(Odometer, GoesWithTheFastest) {
    Trajectory slow({0, 0, 0});
    Trajectory fast({0, 0, 0});
    Odometer odometer;
    odometer.watch(slow, s(0));
    odometer.watch(fast, s(0));
    const double start_m = odometer.reading_m(s(0));
    slow.go_to(s(0), {1000, 0, 0}, 10);
    EXPECT_FALSE(odometer.all_stand());
    EXPECT_NEAR(odometer.reading_m(s(5)) - start_m, 50, 1e-9);
    fast.go_to(s(5), {1000, 0, 0}, 30);
    EXPECT_NEAR(odometer.reading_m(s(7)) - start_m, 110, 1e-9);
}

TEST(Odometer, RenewedForgetsThoseWhoHaveArrived) {
    Trajectory slow({0, 0, 0});
    Trajectory fast({0, 0, 0});
    Odometer odometer;
    odometer.watch(slow, s(0));
    odometer.watch(fast, s(0));
    slow.go_to(s(0), {1000, 0, 0}, 10);
    fast.go_to(s(0), {30, 0, 0}, 30);
    odometer.renew(s(1));
    EXPECT_NEAR(odometer.reading_m(s(2)) - odometer.reading_m(s(1)), 10, 1e-9);
}

TEST(Odometer, KnowsOfWhoMovedBeforeItWatched) {
    Trajectory trajectory({0, 0, 0});
    trajectory.go_to(s(0), {1000, 0, 0}, 10);
    Odometer odometer;
    odometer.watch(trajectory, s(1));
    EXPECT_NEAR(odometer.reading_m(s(3)) - odometer.reading_m(s(1)), 20, 1e-9);
}

TEST(Odometer, CountsLegsThatTakeNoTimeToSpeakOf) {
    Trajectory trajectory({0, 0, 0});
    Odometer odometer;
    odometer.watch(trajectory, s(0));
    trajectory.go_to(s(5), {1e-7, 0, 0}, 1e6);
    EXPECT_NEAR(odometer.reading_m(s(5) + SimTime::from_ps(1)), 1e-7, 1e-14);
}

}  // namespace
}  // namespace netsim
