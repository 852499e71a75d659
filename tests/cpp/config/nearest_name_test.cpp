#include "netsim/config/nearest_name.hpp"

#include <array>

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr std::array<std::string_view, 3> names{"FreeSpacePathLoss", "BreakpointPathLoss", "RayleighFading"};

TEST(NearestName, ExactNameIsItsOwnNearest) {
    EXPECT_EQ(nearest_name("BreakpointPathLoss", names), "BreakpointPathLoss");
}

TEST(NearestName, ForgivesATypingError) {
    EXPECT_EQ(nearest_name("BraekpointPathLoss", names), "BreakpointPathLoss");
    EXPECT_EQ(nearest_name("FreeSpace", names), "FreeSpacePathLoss");
}

TEST(NearestName, IgnoresCase) {
    EXPECT_EQ(nearest_name("RAYLEIGHFADING", names), "RayleighFading");
}

TEST(NearestName, AnswersForTheEmptyNameToo) {
    EXPECT_EQ(nearest_name("", names), "RayleighFading");  // the shortest
}

TEST(NearestName, FirstOfEqualsWins) {
    constexpr std::array<std::string_view, 2> equals{"ab", "ac"};
    EXPECT_EQ(nearest_name("ad", equals), "ab");
}

}  // namespace
}  // namespace netsim
