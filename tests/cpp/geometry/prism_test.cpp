#include "netsim/geometry/prism.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"

namespace netsim {
namespace {

Ring square() {
    return {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
}

Prism house() {
    return Prism({square()}, 0, 5);
}

std::vector<Stretch> stretches(const Prism& prism, const Position& a, const Position& b) {
    Crossing crossing;
    prism.cross(a, b, crossing);
    return crossing.stretches();
}

double length_inside_m(const Prism& prism, const Position& a, const Position& b) {
    double sum_m = 0;
    for (const Stretch& stretch : stretches(prism, a, b)) {
        sum_m += stretch.length_m;
    }
    return sum_m;
}

// Definition of a prism, point by point; the footprint by the winding of all rings around the point.
bool is_inside(const std::vector<Ring>& rings, double base_m, double top_m, const Position& place) {
    if (place.z <= base_m || place.z >= top_m) {
        return false;
    }
    int odd = 0;
    for (const Ring& ring : rings) {
        double turns = 0;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Corner& from = ring[i];
            const Corner& to = ring[(i + 1) % ring.size()];
            const double ax = from[0] - place.x;
            const double ay = from[1] - place.y;
            const double bx = to[0] - place.x;
            const double by = to[1] - place.y;
            turns += std::atan2(ax * by - ay * bx, ax * bx + ay * by);
        }
        odd += static_cast<int>(std::lround(turns / (2 * std::acos(-1.0))));
    }
    return odd % 2 != 0;
}

TEST(Prism, IsCrossedFromWallToWall) {
    const auto found = stretches(house(), {-5, 5, 2}, {15, 5, 2});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].length_m, 10, 1e-12);
    EXPECT_NEAR(found[0].entry_cosine, 1, 1e-12);
    EXPECT_NEAR(found[0].exit_cosine, 1, 1e-12);
}

TEST(Prism, IsCrossedAtTheAngleOfTheSegment) {
    const auto found = stretches(house(), {-10, -5, 2}, {10, 15, 2});  // enters at (0, 5), leaves at (5, 10)
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].length_m, std::sqrt(50), 1e-12);
    EXPECT_NEAR(found[0].entry_cosine, std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(found[0].exit_cosine, std::sqrt(0.5), 1e-12);
}

TEST(Prism, IsEnteredThroughRoofAndFloor) {
    const auto through_both = stretches(house(), {5, 5, 8}, {5, 5, -4});
    ASSERT_EQ(through_both.size(), 1U);
    EXPECT_NEAR(through_both[0].length_m, 5, 1e-12);
    EXPECT_EQ(through_both[0].entry_cosine, 1);
    EXPECT_EQ(through_both[0].exit_cosine, 1);
    const auto aslant =
        stretches(house(), {5, 5, 8}, {13, 5, 2});  // through the roof at (9, 5), the wall at x = 10
    ASSERT_EQ(aslant.size(), 1U);
    EXPECT_NEAR(aslant[0].length_m, 1.25, 1e-12);
    EXPECT_NEAR(aslant[0].entry_cosine, 0.6, 1e-12);
    EXPECT_NEAR(aslant[0].exit_cosine, 0.8, 1e-12);
}

TEST(Prism, IsNotCrossedAboveBelowOrBeside) {
    EXPECT_TRUE(stretches(house(), {-5, 5, 6}, {15, 5, 6}).empty());
    EXPECT_TRUE(stretches(house(), {-5, 5, -1}, {15, 5, -1}).empty());
    EXPECT_TRUE(stretches(house(), {-5, 11, 2}, {15, 11, 2}).empty());
    EXPECT_TRUE(stretches(house(), {-5, 5, 2}, {-1, 5, 2}).empty());
    EXPECT_TRUE(stretches(house(), {20, 20, 6}, {20, 20, -6}).empty());
}

TEST(Prism, ToEndInsideIsToGoThroughOneFace) {
    const auto entering = stretches(house(), {-5, 5, 2}, {4, 5, 2});
    ASSERT_EQ(entering.size(), 1U);
    EXPECT_NEAR(entering[0].length_m, 4, 1e-12);
    EXPECT_NEAR(entering[0].entry_cosine, 1, 1e-12);
    EXPECT_EQ(entering[0].exit_cosine, Stretch::no_face);
    const auto within = stretches(house(), {1, 1, 1}, {1, 4, 5 - 1e-3});
    ASSERT_EQ(within.size(), 1U);
    EXPECT_EQ(within[0].entry_cosine, Stretch::no_face);
    EXPECT_EQ(within[0].exit_cosine, Stretch::no_face);
    const auto lift = stretches(house(), {1, 1, 1}, {1, 1, 9});
    ASSERT_EQ(lift.size(), 1U);
    EXPECT_NEAR(lift[0].length_m, 4, 1e-12);
}

TEST(Prism, WhatStandsOnAFaceGoesThroughTheOthersOnly) {
    const auto from_wall = stretches(house(), {0, 5, 2}, {15, 5, 2});
    ASSERT_EQ(from_wall.size(), 1U);
    EXPECT_EQ(from_wall[0].entry_cosine, Stretch::no_face);
    EXPECT_NEAR(from_wall[0].exit_cosine, 1, 1e-12);
    EXPECT_TRUE(stretches(house(), {0, 5, 2}, {-15, 5, 2}).empty());
    EXPECT_TRUE(stretches(house(), {5, 5, 5}, {5, 5, 20}).empty());
}

TEST(Prism, ToTouchIsNotToCross) {
    EXPECT_TRUE(stretches(house(), {-5, 10, 2}, {15, 10, 2}).empty());  // along a wall
    EXPECT_TRUE(stretches(house(), {-5, 0, 2}, {15, 0, 2}).empty());    // along the opposite one
    EXPECT_TRUE(stretches(house(), {2, 0, 2}, {7, 0, 2}).empty());      // within it
    EXPECT_TRUE(stretches(house(), {-5, 5, 5}, {15, 5, 5}).empty());    // on the roof
    EXPECT_TRUE(stretches(house(), {-5, 5, 0}, {15, 5, 0}).empty());    // on the floor
    EXPECT_TRUE(stretches(house(), {-5, 5, 2}, {5, -5, 2}).empty());    // a corner
    EXPECT_TRUE(stretches(house(), {0, 0, -5}, {0, 0, 15}).empty());    // up an edge
    EXPECT_TRUE(stretches(house(), {0, 5, -5}, {0, 5, 15}).empty());    // up a wall
    EXPECT_TRUE(stretches(house(), {-5, 5, 0}, {5, 5, 10}).empty());    // the edge of the roof
}

TEST(Prism, ASegmentAlongAWallTouchesItAtAnyAngleAndPlace) {
    RandomStream draws(5, 0, Purpose{1002});
    for (int i = 0; i < 2000; ++i) {
        const double angle = 7 * draws.uniform();
        const double far_m = std::pow(10.0, 6 * draws.uniform());
        const double east = std::cos(angle);
        const double north = std::sin(angle);
        const auto turned = [&](double x, double y) {
            return Corner{far_m + x * east - y * north, -far_m + x * north + y * east};
        };
        const Prism prism({{turned(0, 0), turned(10, 0), turned(10, 10), turned(0, 10)}}, 0, 5);
        const Corner a = turned(-5, 0);
        const Corner b = turned(17, 0);
        EXPECT_TRUE(stretches(prism, {a[0], a[1], 1}, {b[0], b[1], 3}).empty()) << i;
        EXPECT_TRUE(stretches(prism, {b[0], b[1], 1}, {a[0], a[1], 3}).empty()) << i;
    }
}

TEST(Prism, ThroughCornersNothingSlipsInWithoutSlippingOut) {
    EXPECT_NEAR(length_inside_m(house(), {-5, -5, 2}, {15, 15, 2}), std::sqrt(200), 1e-12);
    EXPECT_NEAR(length_inside_m(house(), {-5, -5, 2}, {5, 5, 2}), std::sqrt(50), 1e-12);
    EXPECT_NEAR(length_inside_m(house(), {-10, 5, 2}, {10, 10, 2}), 0 + std::hypot(10, 2.5), 1e-12);
}

TEST(Prism, NoSegmentCrossesNothing) {
    EXPECT_TRUE(stretches(house(), {5, 5, 2}, {5, 5, 2}).empty());
    EXPECT_TRUE(stretches(house(), {50, 5, 2}, {50, 5, 2}).empty());
}

TEST(Prism, ACourtyardIsOutside) {
    const Prism block({square(), {{3, 3}, {3, 7}, {7, 7}, {7, 3}}}, 0, 5);
    const auto found = stretches(block, {-5, 5, 2}, {15, 5, 2});
    ASSERT_EQ(found.size(), 2U);
    EXPECT_NEAR(found[0].length_m, 3, 1e-12);
    EXPECT_NEAR(found[1].length_m, 3, 1e-12);
    EXPECT_TRUE(stretches(block, {5, 5, -1}, {5, 5, 9}).empty());
}

TEST(Prism, AnLMayBeCrossedTwice) {
    const Prism corner({{{0, 0}, {10, 0}, {10, 2}, {2, 2}, {2, 10}, {0, 10}}}, 0, 5);
    EXPECT_EQ(stretches(corner, {-1, 9, 1}, {9, -1, 1}).size(), 2U);
    // Along the inner wall, and through the other wing.
    EXPECT_NEAR(length_inside_m(corner, {12, 2, 1}, {-1, 2, 1}), 2, 1e-12);
}

struct Body {
    std::vector<Ring> rings;
    double base_m = 0;
    double top_m = 0;
};

// A star of random radii around a random place, usually not convex, sometimes with a courtyard.
Body random_body(RandomStream& draws) {
    const auto between = [&draws](double low, double high) { return low + draws.uniform() * (high - low); };
    Body body;
    const double x = between(-20, 20);
    const double y = between(-20, 20);
    const auto star = [&](double min_m, double max_m) {
        Ring ring;
        const int corners = 3 + static_cast<int>(draws.uniform_int(7));
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * std::acos(-1.0) * (i + 0.8 * draws.uniform()) / corners;
            const double radius_m = between(min_m, max_m);
            ring.push_back({x + radius_m * std::cos(angle), y + radius_m * std::sin(angle)});
        }
        if (draws.uniform() < 0.5) {
            std::reverse(ring.begin(), ring.end());
        }
        return ring;
    };
    body.rings.push_back(star(8, 20));
    if (draws.uniform() < 0.3) {
        body.rings.push_back(star(0.5, 2));
    }
    body.base_m = between(-5, 5);
    body.top_m = body.base_m + between(1, 20);
    return body;
}

Position random_place(RandomStream& draws) {
    return {60 * draws.uniform() - 30, 60 * draws.uniform() - 30, 40 * draws.uniform() - 15};
}

TEST(Prism, IsWhereItIsPointByPoint) {
    RandomStream draws(7, 0, Purpose{1002});
    constexpr int steps = 400;
    for (int i = 0; i < 3000; ++i) {
        const Body body = random_body(draws);
        const Prism prism(body.rings, body.base_m, body.top_m);
        const Position a = random_place(draws);
        const Position b = draws.uniform() < 0.1 ? Position{a.x, a.y, a.z + 30} : random_place(draws);
        int inside = 0;
        for (int step = 0; step < steps; ++step) {
            inside +=
                is_inside(body.rings, body.base_m, body.top_m, a + (b - a) * ((step + 0.5) / steps)) ? 1 : 0;
        }
        const double length_m = distance(a, b);
        const auto found = stretches(prism, a, b);
        // Each end of a stretch is found to within half a step; a stretch shorter than one may be
        // missed.
        EXPECT_NEAR(length_inside_m(prism, a, b), length_m * inside / steps,
                    (1.0 + static_cast<double>(found.size())) * length_m / steps)
            << i;
    }
}

TEST(Prism, MovedAlongIsCrossedTheSame) {
    RandomStream draws(8, 0, Purpose{1002});
    for (int i = 0; i < 2000; ++i) {
        const Body body = random_body(draws);
        const Position a = random_place(draws);
        const Position b = random_place(draws);
        const Position shift{1e5 * draws.uniform(), -1e5 * draws.uniform(), 100 * draws.uniform()};
        std::vector<Ring> rings = body.rings;
        for (Ring& ring : rings) {
            for (Corner& corner : ring) {
                corner = {corner[0] + shift.x, corner[1] + shift.y};
            }
        }
        const Prism prism(body.rings, body.base_m, body.top_m);
        const Prism moved(rings, body.base_m + shift.z, body.top_m + shift.z);
        EXPECT_NEAR(length_inside_m(prism, a, b), length_inside_m(moved, a + shift, b + shift), 1e-6) << i;
    }
}

}  // namespace
}  // namespace netsim
