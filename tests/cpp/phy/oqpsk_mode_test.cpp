#include "netsim/phy/oqpsk_mode.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

TEST(OqpskMode, DurationsAreThoseOfTheStandard) {
    EXPECT_EQ(oqpsk_250_kbps.duration(0), SimTime::from_us(192));  // 6 octets of 32 µs
    EXPECT_EQ(oqpsk_250_kbps.duration(5), SimTime::from_us(352));  // an ACK: 22 symbols of 16 µs
    EXPECT_EQ(oqpsk_250_kbps.duration(127), SimTime::from_us(4256));
}

TEST(OqpskMode, NoPaddingIsAdded) {
    EXPECT_EQ(oqpsk_250_kbps.data_bits(127), 1016);
}

}  // namespace
}  // namespace netsim
