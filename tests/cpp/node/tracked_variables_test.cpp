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

TEST(TrackedVariables, TellOfEachValueThatIsSet) {
    TrackedVariables variables;
    variables.set("a", std::int64_t{1});
    std::vector<std::pair<std::string, TrackedValue>> told;
    variables.observe(
        [&told](std::string_view name, const TrackedValue& value) { told.emplace_back(name, value); });
    variables.set("a", std::int64_t{2});
    variables.set("a", std::int64_t{2});
    variables.set("b", "on");
    const std::vector<std::pair<std::string, TrackedValue>> expected{
        {"a", std::int64_t{2}}, {"a", std::int64_t{2}}, {"b", std::string("on")}};
    EXPECT_EQ(told, expected);
}

}  // namespace
}  // namespace netsim
