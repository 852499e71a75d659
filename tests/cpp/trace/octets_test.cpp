#include "netsim/trace/octets.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

TEST(Octets, BothOrders) {
    Octets octets;
    append_u8(octets, 0x01);
    append_le16(octets, 0x0203);
    append_le32(octets, 0x04050607);
    append_be16(octets, 0x0809);
    append_be32(octets, 0x0a0b0c0d);
    EXPECT_EQ(octets, (Octets{0x01, 0x03, 0x02, 0x07, 0x06, 0x05, 0x04, 0x08, 0x09, 0x0a, 0x0b, 0x0c, 0x0d}));
}

}  // namespace
}  // namespace netsim
