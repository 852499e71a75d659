#include "netsim/propagation/transmission.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"

namespace netsim {
namespace {

// Channel 1 … 13 of 2.4 GHz.
Band channel(int number, double bandwidth_hz = 22e6) {
    return Band{2.407e9 + number * 5e6, bandwidth_hz};
}

TEST(Band, ASignalOfTheSameBandIsThereAsAWhole) {
    EXPECT_EQ(channel(1).share_in(channel(1)), 1);
    EXPECT_EQ(channel(1, 20e6).share_in(channel(1)), 1);
}

TEST(Band, OfOverlappingChannelsThereIsWhatOverlaps) {
    EXPECT_DOUBLE_EQ(channel(2).share_in(channel(1)), 17.0 / 22);
    EXPECT_DOUBLE_EQ(channel(4).share_in(channel(1)), 7.0 / 22);
}

TEST(Band, ChannelsFarEnoughApartHaveNothingInCommon) {
    EXPECT_EQ(channel(6).share_in(channel(1)), 0);
    EXPECT_EQ(channel(1).share_in(channel(6)), 0);
    EXPECT_EQ(channel(1, 20e6).share_in(channel(5, 20e6)), 0);  // side by side
}

TEST(Band, ANarrowSignalWithinAWideBandIsThereAsAWholeAndDoesNotFitIn) {
    const Band sensor{2.415e9, 2.8e6};
    EXPECT_EQ(sensor.share_in(channel(1)), 1);
    EXPECT_FALSE(sensor.fits_in(channel(1)));
}

TEST(Band, OfAWideSignalANarrowReceiverGetsItsOwnWidth) {
    EXPECT_DOUBLE_EQ(channel(1).share_in(Band{2.415e9, 2.8e6}), 2.8 / 22);
    EXPECT_DOUBLE_EQ(channel(1).share_in(channel(1, 20e6)), 20.0 / 22);
}

TEST(Band, TheOverlapIsTheSameInBothDirections) {
    RandomStream draws(1, 0, Purpose{1000});
    for (int i = 0; i < 10'000; ++i) {
        const Band a{2.4e9 + 100e6 * draws.uniform(), 1e6 + 40e6 * draws.uniform()};
        const Band b{2.4e9 + 100e6 * draws.uniform(), 1e6 + 40e6 * draws.uniform()};
        const double share = a.share_in(b);
        EXPECT_GE(share, 0);
        EXPECT_LE(share, 1);
        EXPECT_NEAR(share * a.bandwidth_hz, b.share_in(a) * b.bandwidth_hz, 1e-3);
    }
}

}  // namespace
}  // namespace netsim
