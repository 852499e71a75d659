#include "netsim/interface_id.hpp"

#include <set>

#include <gtest/gtest.h>

namespace netsim {
namespace {

TEST(InterfaceId, TheStreamOfTheFirstInterfaceHasTheNameOfTheNode) {
    EXPECT_EQ((InterfaceId{7, 0}.stream()), 7U);
    EXPECT_EQ((InterfaceId{InterfaceId::max_nodes - 1, 0}.stream()), 0xFFFFFFU);
}

TEST(InterfaceId, NoTwoInterfacesShareAStream) {
    std::set<std::uint32_t> streams;
    for (const NodeId node : {0, 1, 2, InterfaceId::max_nodes - 1}) {
        for (std::int32_t index = 0; index < 16; ++index) {
            streams.insert(InterfaceId{node, index}.stream());
        }
    }
    EXPECT_EQ(streams.size(), 4U * 16U);
}

TEST(InterfaceId, InterfacesAreOrderedByNodeFirst) {
    EXPECT_LT((InterfaceId{1, 5}), (InterfaceId{2, 0}));
    EXPECT_LT((InterfaceId{1, 0}), (InterfaceId{1, 1}));
}

TEST(InterfaceId, IsFoundAgainByItsStream) {
    for (const InterfaceId id :
         {InterfaceId{0, 0}, InterfaceId{7, 3}, InterfaceId{InterfaceId::max_nodes - 1, 255}}) {
        EXPECT_EQ(InterfaceId::of_stream(id.stream()), id);
    }
}

}  // namespace
}  // namespace netsim
