#include "netsim/mobility/gauss_markov.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

GaussMarkov processes(std::uint64_t seed = 1) {
    return {RandomStream(seed, 0, Purpose::gusts), {1, 2, 3}, 5.0, 0.5};
}

TEST(GaussMarkov, HasItsDeviationsAndItsCorrelation) {
    GaussMarkov process = processes();
    constexpr int count = 100'000;
    constexpr int lag = 10;  // one correlation time
    std::vector<Position> values;
    for (int number = 0; number < count; ++number) {
        values.push_back(process.at(number * 0.5));
    }
    Position squares;
    double products = 0;
    for (int number = lag; number < count; ++number) {
        const Position& value = values[number];
        squares = squares + Position{value.x * value.x, value.y * value.y, value.z * value.z};
        products += value.x * values[number - lag].x;
    }
    // About 5,000 independent values: 1 % of error.
    EXPECT_NEAR(std::sqrt(squares.x / count), 1, 0.03);
    EXPECT_NEAR(std::sqrt(squares.y / count), 2, 0.06);
    EXPECT_NEAR(std::sqrt(squares.z / count), 3, 0.09);
    EXPECT_NEAR(products / squares.x, std::exp(-1), 0.05);
}

TEST(GaussMarkov, IsLinearBetweenTwoDraws) {
    GaussMarkov process = processes();
    const Position before = process.at(0.5);
    const Position between = process.at(0.625);
    const Position after = process.at(1.0);
    EXPECT_NEAR(between.x, before.x + (after.x - before.x) / 4, 1e-12);
    EXPECT_NEAR(between.z, before.z + (after.z - before.z) / 4, 1e-12);
}

TEST(GaussMarkov, DoesNotDependOnTheTimesOfCalls) {
    GaussMarkov often = processes();
    for (int number = 0; number < 100; ++number) {
        often.at(number * 0.1);
    }
    GaussMarkov once = processes();
    EXPECT_EQ(often.at(10), once.at(10));
    EXPECT_NE(processes(2).at(10), once.at(10));
}

}  // namespace
}  // namespace netsim
