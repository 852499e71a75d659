#include "netsim/node/filler.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

TEST(Filler, HasAsManyOctetsAsAreAskedFor) {
    Filler filler;
    EXPECT_EQ(filler.of(3)->size(), 3U);
    EXPECT_EQ(filler.of(0)->size(), 0U);
    EXPECT_EQ(filler.of(5)->size(), 5U);
}

TEST(Filler, IsOneTextForAllWhoAskForAsMany) {
    Filler filler;
    const Payload first = filler.of(100);
    EXPECT_EQ(filler.of(100), first);
}

}  // namespace
}  // namespace netsim
