#include "netsim/geometry/position.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

TEST(Position, IsTheOriginByDefault) {
    EXPECT_EQ(Position(), (Position{0, 0, 0}));
}

TEST(Position, ArithmeticWorksPerCoordinate) {
    constexpr Position a{1, 2, 3};
    constexpr Position b{10, 20, 30};
    static_assert(a + b == Position{11, 22, 33});
    static_assert(b - a == Position{9, 18, 27});
    static_assert(a * 2 == Position{2, 4, 6});
    static_assert(2 * a == a * 2);
}

TEST(Position, DistanceOfABoxDiagonal) {
    constexpr Position a{1, 1, 1};
    constexpr Position b{3, 4, 7};  // 2, 3, 6: diagonal 7
    static_assert(squared_distance(a, b) == 49);
    EXPECT_DOUBLE_EQ(distance(a, b), 7);
}

TEST(Position, DistanceIsSymmetric) {
    constexpr Position a{1.5, -2.25, 0.1};
    constexpr Position b{-4, 3, 100};
    EXPECT_EQ(distance(a, b), distance(b, a));
    EXPECT_EQ(distance(a, a), 0);
}

}  // namespace
}  // namespace netsim
