#include "netsim/mobility/attitude.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr double quarter = std::numbers::pi / 2;

SimTime s(double seconds) {
    return SimTime::from_seconds(seconds);
}

// Direction of its nose.
void expect_nose(const Attitude& attitude, const Trajectory& trajectory, double time_s,
                 const Position& expected) {
    const Position nose = attitude.at(trajectory, s(time_s)).to_scene({1, 0, 0});
    EXPECT_LT(distance(nose, expected), 1e-9) << nose.x << ", " << nose.y << ", " << nose.z;
}

MobilityConfig config(bool face_forward, double heading_rad) {
    MobilityConfig mobility;
    mobility.face_forward = face_forward;
    mobility.initial_orientation.heading_rad = heading_rad;
    return mobility;
}

TEST(Attitude, StaysAsItWas) {
    Trajectory trajectory({0, 0, 0});
    trajectory.go_to(s(1), {0, -100, 0}, 10);
    const Attitude attitude(config(false, quarter));
    expect_nose(attitude, trajectory, 0, {0, 1, 0});
    expect_nose(attitude, trajectory, 5, {0, 1, 0});
}

TEST(Attitude, FacesForward) {
    Trajectory trajectory({0, 0, 0});
    trajectory.go_to(s(1), {30, 0, 40}, 10);
    const Attitude attitude(config(true, quarter));
    expect_nose(attitude, trajectory, 0.5, {0, 1, 0});  // it has not moved
    expect_nose(attitude, trajectory, 1, {0, 1, 0});
    expect_nose(attitude, trajectory, 1.001, {0.6, 0, 0.8});
    expect_nose(attitude, trajectory, 5, {0.6, 0, 0.8});
}

TEST(Attitude, KeepsItsDirectionWhenItArrivesOrIsStopped) {
    Trajectory trajectory({0, 0, 0});
    const Attitude attitude(config(true, 0));
    trajectory.go_to(s(0), {0, 10, 0}, 10);
    expect_nose(attitude, trajectory, 100, {0, 1, 0});
    trajectory.go_to(s(200), {0, 0, 0}, 10);
    trajectory.stop(s(200.5));
    expect_nose(attitude, trajectory, 300, {0, -1, 0});
    trajectory.go_to(s(300), {100, 5, 0}, 0);
    expect_nose(attitude, trajectory, 301, {0, -1, 0});
}

TEST(Attitude, IsKnownForTheLastSecond) {
    Trajectory trajectory({0, 0, 0});
    const Attitude attitude(config(true, 0));
    trajectory.go_to(s(0), {0, 10, 0}, 1);
    trajectory.go_to(s(5), {0, 0, 0}, 1);
    trajectory.stop(s(5.2));
    expect_nose(attitude, trajectory, 4.9, {0, 1, 0});
    expect_nose(attitude, trajectory, 5.1, {0, -1, 0});
}

TEST(Attitude, CommandsDoNotChangeTheInstantInWhichTheyAreGiven) {
    Trajectory trajectory({0, 0, 0});
    const Attitude attitude(config(true, 0));
    trajectory.go_to(s(0), {0, 10, 0}, 1);
    expect_nose(attitude, trajectory, 5, {0, 1, 0});
    trajectory.go_to(s(5), {100, 5, 0}, 1);
    expect_nose(attitude, trajectory, 5, {0, 1, 0});
    trajectory.go_to(s(6), {100, 500, 0}, 1);
    expect_nose(attitude, trajectory, 5, {0, 1, 0});
    expect_nose(attitude, trajectory, 6, {1, 0, 0});
}

TEST(Attitude, OfCommandsInOneInstantTheLastCounts) {
    Trajectory trajectory({0, 0, 0});
    const Attitude attitude(config(true, 0));
    trajectory.go_to(s(0), {0, 10, 0}, 1);
    trajectory.go_to(s(5), {100, 5, 0}, 1);
    trajectory.stop(s(5));
    expect_nose(attitude, trajectory, 6, {0, 1, 0});
}

}  // namespace
}  // namespace netsim
