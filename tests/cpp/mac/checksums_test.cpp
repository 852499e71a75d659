#include "netsim/mac/checksums.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(Checksums, TheCrcOfTheUsualCheckString) {
    const std::string check = "123456789";
    EXPECT_EQ(frame_check_sequence(Bytes(check.begin(), check.end())), 0xcbf43926U);
}

TEST(Checksums, TheNarrowbandCrcOfTheUsualCheckString) {
    const std::string check = "123456789";
    EXPECT_EQ(narrowband_check_sequence(Bytes(check.begin(), check.end())), 0x2189);  // CRC-16/KERMIT
}

// IEEE Std 802.15.4-2006, 7.2.1.9: an ACK with sequence number 0x6a (in the order of sending
// 01010110).
TEST(Checksums, TheExampleOf802154) {
    EXPECT_EQ(narrowband_check_sequence(Bytes{0x02, 0x00, 0x6a}), 0x79e4);
}

TEST(Checksums, TheCrcOfNothingIsZero) {
    EXPECT_EQ(frame_check_sequence({}), 0U);
}

// RFC 1071, section 3: 00 01 f2 03 f4 f5 f6 f7 sum to ddf2.
TEST(Checksums, TheExampleOfTheRfc) {
    EXPECT_EQ(internet_checksum(Bytes{0x00, 0x01, 0xf2, 0x03, 0xf4, 0xf5, 0xf6, 0xf7}), 0xffff - 0xddf2);
}

TEST(Checksums, AnOddOctetIsTheHighOne) {
    EXPECT_EQ(internet_checksum(Bytes{0x12, 0x34, 0x56}), 0xffff - (0x1234 + 0x5600));
}

TEST(Checksums, OverWhatHoldsItsChecksumTheResultIsZero) {
    const Bytes ipv4_header{0x45, 0x00, 0x00, 0x73, 0x00, 0x00, 0x40, 0x00, 0x40, 0x11,
                            0xb8, 0x61, 0xc0, 0xa8, 0x00, 0x01, 0xc0, 0xa8, 0x00, 0xc7};
    EXPECT_EQ(internet_checksum(ipv4_header), 0);
}

}  // namespace
}  // namespace netsim
