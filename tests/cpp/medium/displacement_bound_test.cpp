#include "netsim/medium/displacement_bound.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

SimTime s(double seconds) {
    return SimTime::from_seconds(seconds);
}

TEST(DisplacementBound, IsConstantWhileAllStand) {
    const Trajectory place({1, 2, 3});
    DisplacementBound displacement;
    displacement.watch(place, s(0));
    EXPECT_TRUE(displacement.all_stand());
    EXPECT_EQ(displacement.total_m(s(1000)), displacement.total_m(s(0)));
}

TEST(DisplacementBound, GrowsWithTheFastestNode) {
    Trajectory slow({0, 0, 0});
    Trajectory fast({0, 0, 0});
    DisplacementBound displacement;
    displacement.watch(slow, s(0));
    displacement.watch(fast, s(0));
    const double start_m = displacement.total_m(s(0));
    slow.go_to(s(0), {1000, 0, 0}, 10);
    EXPECT_FALSE(displacement.all_stand());
    EXPECT_NEAR(displacement.total_m(s(5)) - start_m, 50, 1e-9);
    fast.go_to(s(5), {1000, 0, 0}, 30);
    EXPECT_NEAR(displacement.total_m(s(7)) - start_m, 110, 1e-9);
}

TEST(DisplacementBound, RefreshIgnoresNodesThatArrived) {
    Trajectory slow({0, 0, 0});
    Trajectory fast({0, 0, 0});
    DisplacementBound displacement;
    displacement.watch(slow, s(0));
    displacement.watch(fast, s(0));
    slow.go_to(s(0), {1000, 0, 0}, 10);
    fast.go_to(s(0), {30, 0, 0}, 30);
    displacement.refresh(s(1));
    EXPECT_NEAR(displacement.total_m(s(2)) - displacement.total_m(s(1)), 10, 1e-9);
}

TEST(DisplacementBound, CountsNodesThatMovedBeforeWatching) {
    Trajectory trajectory({0, 0, 0});
    trajectory.go_to(s(0), {1000, 0, 0}, 10);
    DisplacementBound displacement;
    displacement.watch(trajectory, s(1));
    EXPECT_NEAR(displacement.total_m(s(3)) - displacement.total_m(s(1)), 20, 1e-9);
}

TEST(DisplacementBound, CountsVeryShortLegs) {
    Trajectory trajectory({0, 0, 0});
    DisplacementBound displacement;
    displacement.watch(trajectory, s(0));
    trajectory.go_to(s(5), {1e-7, 0, 0}, 1e6);
    EXPECT_NEAR(displacement.total_m(s(5) + SimTime::from_ps(1)), 1e-7, 1e-14);
}

}  // namespace
}  // namespace netsim
