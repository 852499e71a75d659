#include "netsim/medium/neighbor_search.hpp"

#include <deque>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"

namespace netsim {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

SimTime s(double seconds) {
    return SimTime::from_seconds(seconds);
}

struct Crowd {
    Trajectory& add(Position place) {
        Trajectory& trajectory = trajectories.emplace_back(place);
        displacement.watch(trajectory, s(0));
        neighbors.add(static_cast<NodeId>(trajectories.size()) - 1, trajectory);
        return trajectory;
    }
    // Those that a visit finds within the radius; whether it comes once and with the right position
    // is checked.
    std::set<NodeId> found(Position centre, double radius_m, SimTime now, double reach_m) {
        neighbors.prepare(now, displacement, reach_m);
        std::set<NodeId> near;
        std::set<NodeId> visited;
        for (const auto& [place, node] : neighbors.near(centre, radius_m)) {
            EXPECT_TRUE(visited.insert(node).second) << node;
            EXPECT_EQ(place, trajectories[node].position_at(now)) << node;
            if (distance(centre, place) <= radius_m) {
                near.insert(node);
            }
        }
        return near;
    }
    std::set<NodeId> expected(Position centre, double radius_m, SimTime now) const {
        std::set<NodeId> near;
        for (NodeId node = 0; node < static_cast<NodeId>(trajectories.size()); ++node) {
            if (distance(centre, trajectories[node].position_at(now)) <= radius_m) {
                near.insert(node);
            }
        }
        return near;
    }

    std::deque<Trajectory> trajectories;
    DisplacementBound displacement;
    NeighborSearch neighbors;
};

class NeighborSearchAtScale : public testing::TestWithParam<double> {};

TEST_P(NeighborSearchAtScale, FindsAll) {
    RandomStream draws(1, 0, Purpose{1004});
    const double side_m = GetParam();
    const auto coordinate = [&] { return (draws.uniform() - 0.5) * side_m; };
    Crowd crowd;
    for (int i = 0; i < 500; ++i) {
        crowd.add({coordinate(), coordinate(), coordinate() / 100});
    }
    for (int i = 0; i < 500; ++i) {
        const Position centre{coordinate(), coordinate(), 0};
        const double radius_m = 300 * draws.uniform();
        EXPECT_EQ(crowd.found(centre, radius_m, s(i), 250), crowd.expected(centre, radius_m, s(i)));
    }
}

INSTANTIATE_TEST_SUITE_P(Sides, NeighborSearchAtScale, testing::Values(0.0, 1.0, 1e3, 1e4, 1e6, 1e9, 1e15));

TEST(NeighborSearch, FindsRadiosOnCellBorders) {
    Crowd crowd;
    constexpr double reach_m = 100;  // cells of 50 m
    for (int x = -10; x < 10; ++x) {
        for (int y = -10; y < 10; ++y) {
            crowd.add({50.0 * x, 50.0 * y, 0});
        }
    }
    for (const double radius_m : {0.0, 50.0, 100.0, 150.0, 1000.0, infinite}) {
        EXPECT_EQ(crowd.found({0, 0, 0}, radius_m, s(0), reach_m), crowd.expected({0, 0, 0}, radius_m, s(0)));
        EXPECT_EQ(crowd.found({-450, 25, 0}, radius_m, s(0), reach_m),
                  crowd.expected({-450, 25, 0}, radius_m, s(0)));
    }
}

TEST(NeighborSearch, FindsRadiosAfterAnyMovement) {
    RandomStream draws(2, 0, Purpose{1004});
    Crowd crowd;
    const auto somewhere = [&] { return Position{draws.uniform() * 3000, draws.uniform() * 3000, 0}; };
    for (int i = 0; i < 200; ++i) {
        crowd.add(somewhere());
    }
    SimTime now;
    for (int i = 0; i < 2000; ++i) {
        now += SimTime::from_us(draws.uniform_int(100'000));
        const auto mover = draws.uniform_int(200);
        const double speed_mps = std::pow(10, 4 * draws.uniform() - 1);
        crowd.trajectories[mover].go_to(now, somewhere(), speed_mps);
        const Position centre = somewhere();
        EXPECT_EQ(crowd.found(centre, 200, now, 200), crowd.expected(centre, 200, now));
    }
}

TEST(NeighborSearch, ReturnsFewDistantRadios) {
    Crowd crowd;
    for (int i = 0; i < 10'000; ++i) {
        const int column = i % 100;
        const int row = i / 100;
        crowd.add({100.0 * column, 100.0 * row, 0});
    }
    crowd.neighbors.prepare(s(0), crowd.displacement, 200);
    EXPECT_EQ(crowd.neighbors.near({5000, 5000, 0}, 200).size(), 13U);
}

TEST(NeighborSearch, FarthestBoundsAllDistances) {
    Crowd crowd;
    for (int i = 0; i < 100; ++i) {
        crowd.add({10.0 * i, 0, 0});
    }
    Trajectory& traveller = crowd.add({0, 0, 0});
    traveller.go_to(s(0), {0, 1e6, 0}, 10);
    for (int i = 0; i < 1000; ++i) {
        crowd.neighbors.prepare(s(i), crowd.displacement, 100);
        const double farthest_m = crowd.neighbors.farthest_m({0, 0, 0});
        EXPECT_GE(farthest_m, distance({0, 0, 0}, traveller.position_at(s(i))));
        EXPECT_LE(farthest_m, std::hypot(990, 10.0 * i) + 50);
    }
}

TEST(NeighborSearch, FarthestBoundsMovedNodes) {
    Crowd crowd;
    crowd.add({0, 0, 0});
    Trajectory& traveller = crowd.add({1000, 0, 0});
    traveller.go_to(s(0), {1e6, 0, 0}, 1);
    for (int i = 0; i < 1000; ++i) {
        crowd.neighbors.prepare(s(i), crowd.displacement, 100);
        ASSERT_GE(crowd.neighbors.farthest_m({0, 0, 0}), traveller.position_at(s(i)).x);
    }
}

TEST(NeighborSearch, IsEmptyWithoutRadios) {
    Crowd crowd;
    EXPECT_TRUE(crowd.found({0, 0, 0}, infinite, s(0), 100).empty());
    EXPECT_EQ(crowd.neighbors.farthest_m({0, 0, 0}), 0);
}

}  // namespace
}  // namespace netsim
