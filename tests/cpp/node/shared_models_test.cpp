#include "netsim/node/shared_models.hpp"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

struct Kinds {
    std::shared_ptr<const int> of(int config) {
        return shared.of(config, [this](int made_of) {
            made.push_back(made_of);
            return std::make_shared<const int>(made_of);
        });
    }

    SharedModels<int, int> shared;
    std::vector<int> made;
};

TEST(SharedModels, AreCreatedOnceForEqualConfigurations) {
    Kinds kinds;
    const auto first = kinds.of(1);
    const auto other = kinds.of(2);
    EXPECT_EQ(kinds.of(1), first);
    EXPECT_EQ(kinds.of(2), other);
    EXPECT_EQ(*first, 1);
    EXPECT_EQ(*other, 2);
    EXPECT_EQ(kinds.made, (std::vector{1, 2}));
}

TEST(SharedModels, StayValidAfterTheyAreDropped) {
    Kinds kinds;
    const auto first = kinds.of(0);
    for (int config = 1; config <= 100; ++config) {
        kinds.of(config);
    }
    EXPECT_EQ(*first, 0);
    EXPECT_EQ(*kinds.of(0), 0);
}

}  // namespace
}  // namespace netsim
