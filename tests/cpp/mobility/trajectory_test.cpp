#include "netsim/mobility/trajectory.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

SimTime s(double seconds) {
    return SimTime::from_seconds(seconds);
}

void expect_near(const Position& position, const Position& expected, double tolerance_m = 1e-9) {
    EXPECT_NEAR(position.x, expected.x, tolerance_m);
    EXPECT_NEAR(position.y, expected.y, tolerance_m);
    EXPECT_NEAR(position.z, expected.z, tolerance_m);
}

TEST(Trajectory, StandsWhereItWasPut) {
    const Trajectory trajectory({1, 2, 3});
    EXPECT_EQ(trajectory.position_at(s(0)), (Position{1, 2, 3}));
    EXPECT_EQ(trajectory.position_at(s(1e6)), (Position{1, 2, 3}));
}

TEST(Trajectory, IsAStraightLineAtConstantSpeed) {
    Trajectory trajectory({0, 0, 0});
    trajectory.go_to(s(10), {30, 40, 0}, 5);  // 50 m in 10 s
    expect_near(trajectory.position_at(s(10)), {0, 0, 0});
    expect_near(trajectory.position_at(s(11)), {3, 4, 0});
    expect_near(trajectory.position_at(s(15)), {15, 20, 0});
}

TEST(Trajectory, StandsExactlyAtItsTargetFromTheArrivalOn) {
    Trajectory trajectory({0.1, 0, 0});
    trajectory.go_to(s(0), {0.7, 0.3, -0.9}, 0.1);
    EXPECT_EQ(trajectory.position_at(s(1000)), (Position{0.7, 0.3, -0.9}));
}

TEST(Trajectory, ChangesCourseWhereItIs) {
    Trajectory trajectory({0, 0, 0});
    trajectory.go_to(s(0), {100, 0, 0}, 10);
    trajectory.go_to(s(4), {40, 30, 0}, 10);  // from (40, 0)
    expect_near(trajectory.position_at(s(4)), {40, 0, 0});
    expect_near(trajectory.position_at(s(5)), {40, 10, 0});
    expect_near(trajectory.position_at(s(8)), {40, 30, 0});
}

TEST(Trajectory, StopsWhereItIs) {
    Trajectory trajectory({0, 0, 0});
    trajectory.go_to(s(0), {100, 0, 0}, 10);
    trajectory.stop(s(4));
    expect_near(trajectory.position_at(s(50)), {40, 0, 0});
}

TEST(Trajectory, OfCommandsInOneInstantTheLastCounts) {
    Trajectory trajectory({0, 0, 0});
    trajectory.go_to(s(1), {100, 0, 0}, 10);
    trajectory.go_to(s(1), {0, 100, 0}, 10);
    expect_near(trajectory.position_at(s(2)), {0, 10, 0});
}

TEST(Trajectory, RemembersWhereItWasWithinItsMemory) {
    Trajectory trajectory({0, 0, 0});
    trajectory.go_to(s(0), {1000, 0, 0}, 10);
    for (int change = 1; change <= 100; ++change) {  // every 50 ms, back and forth across the line
        trajectory.go_to(s(10 + 0.05 * change), {1000, change % 2 == 0 ? 1000.0 : -1000.0, 0}, 10);
    }
    const SimTime newest = s(15);
    Trajectory with_fewer({0, 0, 0});  // the same up to 14 s
    with_fewer.go_to(s(0), {1000, 0, 0}, 10);
    for (int change = 1; change <= 80; ++change) {
        with_fewer.go_to(s(10 + 0.05 * change), {1000, change % 2 == 0 ? 1000.0 : -1000.0, 0}, 10);
    }
    EXPECT_EQ(trajectory.position_at(newest - Trajectory::memory), with_fewer.position_at(s(14)));
}

TEST(Trajectory, LooksBackIntoALegThatBeganLongBefore) {
    Trajectory trajectory({0, 0, 0});
    trajectory.go_to(s(0), {1000, 0, 0}, 10);
    trajectory.go_to(s(50), {500, 500, 0}, 10);
    expect_near(trajectory.position_at(s(49.5)), {495, 0, 0});
}

TEST(Trajectory, WithoutSpeedItStands) {
    Trajectory trajectory({1, 2, 3});
    trajectory.go_to(s(0), {100, 0, 0}, 0);
    EXPECT_EQ(trajectory.position_at(s(1e6)), (Position{1, 2, 3}));
}

TEST(Trajectory, ALegOfNoLengthStands) {
    Trajectory trajectory({1, 2, 3});
    trajectory.go_to(s(5), {1, 2, 3}, 10);
    EXPECT_EQ(trajectory.position_at(s(5)), (Position{1, 2, 3}));
    EXPECT_EQ(trajectory.position_at(s(6)), (Position{1, 2, 3}));
}

TEST(Trajectory, TheShortestLegTakesAPicosecond) {
    Trajectory trajectory({0, 0, 0});
    trajectory.go_to(s(5), {1e-12, 0, 0}, 1e6);
    EXPECT_EQ(trajectory.position_at(s(5)), (Position{0, 0, 0}));
    EXPECT_EQ(trajectory.position_at(s(5) + SimTime::from_ps(1)), (Position{1e-12, 0, 0}));
}

TEST(Trajectory, TargetsTooFarToReachKeepTheirDirection) {
    Trajectory trajectory({0, 0, 0});
    trajectory.go_to(s(0), {3e12, 4e12, 0}, 10);
    expect_near(trajectory.position_at(s(1000)), {6000, 8000, 0}, 1e-6);
}

TEST(Trajectory, CrawlingIsStillMoving) {
    Trajectory trajectory({0, 0, 0});
    trajectory.go_to(s(0), {1, 0, 0}, 1e-9);
    expect_near(trajectory.position_at(s(1e6)), {1e-3, 0, 0});
}

TEST(Trajectory, CrawlsLateInALongRun) {
    Trajectory trajectory({0, 0, 0});
    trajectory.go_to(s(9e6), {1, 0, 0}, 1e-9);
    expect_near(trajectory.position_at(s(9.1e6)), {1e-4, 0, 0});
}

TEST(Trajectory, HasASpeedUntilItArrives) {
    Trajectory trajectory({0, 0, 0});
    EXPECT_EQ(trajectory.speed_mps(s(0)), 0);
    trajectory.go_to(s(10), {30, 40, 0}, 5);
    EXPECT_NEAR(trajectory.speed_mps(s(10)), 5, 1e-9);
    EXPECT_NEAR(trajectory.speed_mps(s(19.9)), 5, 1e-9);
    EXPECT_EQ(trajectory.speed_mps(s(20)), 0);
}

class Course final : public CourseListener {
public:
    void course_changed(SimTime now, double speed_mps) override {
        changes.push_back({now.seconds(), speed_mps});
    }
    std::vector<std::array<double, 2>> changes;
};

TEST(Trajectory, TellsItsListenerOfEachChangeOfCourse) {
    Trajectory trajectory({0, 0, 0});
    Course course;
    trajectory.set_listener(course);
    trajectory.go_to(s(1), {100, 0, 0}, 10);
    trajectory.stop(s(2));
    trajectory.go_to(s(3), {10 + 1e-8, 0, 0}, 1e6);  // in a picosecond
    ASSERT_EQ(course.changes.size(), 3U);
    EXPECT_EQ(course.changes[0], (std::array{1.0, 10.0}));
    EXPECT_EQ(course.changes[1], (std::array{2.0, 0.0}));
    EXPECT_NEAR(course.changes[2][1], 1e4, 0.1);
}

}  // namespace
}  // namespace netsim
