#include "netsim/node/payload_padding.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

TEST(PayloadPadding, HasTheRequestedSize) {
    PayloadPadding padding;
    EXPECT_EQ(padding.of(3)->size(), 3U);
    EXPECT_EQ(padding.of(0)->size(), 0U);
    EXPECT_EQ(padding.of(5)->size(), 5U);
}

TEST(PayloadPadding, IsSharedForEqualSizes) {
    PayloadPadding padding;
    const Payload first = padding.of(100);
    EXPECT_EQ(padding.of(100), first);
}

}  // namespace
}  // namespace netsim
