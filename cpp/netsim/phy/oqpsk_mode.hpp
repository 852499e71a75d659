// The only mode of IEEE 802.15.4 at 2.4 GHz: O-QPSK with 250 kbps.
//
// A frame lasts 128 µs of preamble (4 octets) + 64 µs of header (start-of-frame delimiter and length,
// one octet each) + 32 µs per byte of the PSDU. A symbol has 4 bits and lasts 16 µs.
//
// Source: IEEE Std 802.15.4-2006, 6.3 (PPDU format) and 6.5 (2450 MHz PHY).
#pragma once

#include "netsim/phy/modes.hpp"

namespace netsim {

inline constexpr Mode oqpsk_250_kbps{.name = "O-QPSK 250 kbps",
                                     .format = PpduFormat::oqpsk,
                                     .family = ModeFamily::oqpsk,
                                     .bitrate_bps = 250'000,
                                     .mandatory = true,
                                     .signal_extension = SimTime(),
                                     .preamble = SimTime::from_us(128),
                                     .header = SimTime::from_us(64),
                                     .header_bits = 16,
                                     .header_bitrate_bps = 250'000,
                                     .phy_rx_start_delay = SimTime::from_us(192)};

}  // namespace netsim
