#include "netsim/trace/radiotap.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

Octets octets_of(const Radiotap& radiotap) {
    Octets octets;
    append_radiotap(octets, radiotap);
    return octets;
}

Radiotap received_at_24_mbps(Radiotap::Received received = {1e-10, 1e-14, true}) {
    Radiotap radiotap;
    radiotap.bitrate_bps = 24'000'000;
    radiotap.carrier_hz = 2.412e9;
    radiotap.received = received;
    return radiotap;
}

TEST(Radiotap, OfAReceivedFrame) {
    EXPECT_EQ(octets_of(received_at_24_mbps()),
              (Octets{0x00, 0x00, 0x10, 0x00,  // version, padding, 16 octets
                      0x6e, 0x00, 0x00, 0x00,  // which fields
                      0x10,                    // FCS at the end
                      48,                      // 24 Mbps
                      0x6c, 0x09, 0xc0, 0x00,  // 2412 MHz, OFDM in 2.4 GHz
                      0xba,                    // -70 dBm
                      0x92}));                 // -110 dBm
}

TEST(Radiotap, OfASentFrame) {
    Radiotap radiotap;
    radiotap.bitrate_bps = 5'500'000;
    radiotap.carrier_hz = 2.437e9;
    radiotap.modulation = ChannelModulation::cck;
    radiotap.tx_power_w = 0.02;
    EXPECT_EQ(octets_of(radiotap), (Octets{0x00, 0x00, 0x0f, 0x00,  // 15 octets
                                           0x0e, 0x04, 0x00, 0x00,  // which fields
                                           0x10,                    // FCS at the end
                                           11,                      // 5.5 Mbps
                                           0x85, 0x09, 0xa0, 0x00,  // 2437 MHz, CCK in 2.4 GHz
                                           13}));                   // dBm
}

TEST(Radiotap, AFrameThatFailedHasABadFcs) {
    EXPECT_EQ(octets_of(received_at_24_mbps({1e-10, 1e-14, false}))[8], 0x50);
}

TEST(Radiotap, AChannelOf5Ghz) {
    Radiotap radiotap = received_at_24_mbps();
    radiotap.carrier_hz = 5.18e9;
    EXPECT_EQ(octets_of(radiotap)[12] | octets_of(radiotap)[13] << 8, 0x0140);
}

TEST(Radiotap, AChannelOfAnotherBand) {
    Radiotap radiotap = received_at_24_mbps();
    radiotap.carrier_hz = 868.3e6;
    EXPECT_EQ(octets_of(radiotap)[10] | octets_of(radiotap)[11] << 8, 868);
    EXPECT_EQ(octets_of(radiotap)[12] | octets_of(radiotap)[13] << 8, 0x0040);
}

TEST(Radiotap, PowersOutsideAnOctetAreCut) {
    const Octets octets = octets_of(received_at_24_mbps({0, 1e30, true}));
    EXPECT_EQ(octets[14], 0x80);
    EXPECT_EQ(octets[15], 0x7f);
}

}  // namespace
}  // namespace netsim
