// The radiotap header before each 802.11 frame in a capture file: bitrate, channel and powers.
//
// Source: radiotap.org, fields Flags, Rate, Channel, Antenna signal, Antenna noise and TX power.
#pragma once

#include <cstdint>
#include <optional>

#include "netsim/trace/octets.hpp"

namespace netsim {

enum class ChannelModulation { cck, ofdm };  // DSSS counts as CCK

struct Radiotap {
    struct Received {
        double signal_w = 0;
        double noise_w = 0;
        bool decoded = true;  // if false, the bad FCS flag is set
    };

    std::int64_t bitrate_bps = 0;
    double carrier_hz = 0;
    ChannelModulation modulation = ChannelModulation::ofdm;
    double tx_power_w = 0;             // only for a sent frame
    std::optional<Received> received;  // only for a received frame
};

// Appends the header. Powers are rounded to integer dBm within -128 … 127, and the frequency to
// integer MHz within 0 … 65535.
void append_radiotap(Octets& octets, const Radiotap& radiotap);

}  // namespace netsim
