#include "netsim/node/tracked_variables.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

TEST(TrackedVariables, KeepTheOrderInWhichTheyWereFirstSet) {
    TrackedVariables variables;
    variables.set("b", std::int64_t{1});
    variables.set("a", 0.5);
    variables.set("b", std::int64_t{2});
    const std::vector<std::pair<std::string, TrackedValue>> expected{{"b", std::int64_t{2}}, {"a", 0.5}};
    EXPECT_EQ(variables.values(), expected);
}

}  // namespace
}  // namespace netsim
