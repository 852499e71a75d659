// The time intervals of channel access, derived from the operation mode.
//
// Source: IEEE 802.11-2020, 10.3.2.3 (interframe spaces) and 10.3.2.11 (ACK procedure), 10.3.2.9
// (CTS procedure).
#pragma once

#include "netsim/kernel/sim_time.hpp"
#include "netsim/mac/frame.hpp"
#include "netsim/phy/modes.hpp"

namespace netsim {

struct MacTiming {
    SimTime slot;
    SimTime sifs;
    SimTime difs;  // SIFS + 2 slots
    SimTime eifs;  // SIFS + DIFS + an ACK at the slowest mandatory rate

    explicit MacTiming(const ModeSet& modes)
        : slot(modes.slot()),
          sifs(modes.sifs()),
          difs(modes.sifs() + modes.slot() * 2),
          eifs(sifs + difs + modes.slowest_mandatory().duration(ack_bytes)) {}

    // From the end of a frame until its sender stops waiting for the start of an ACK or CTS in mode
    // `response`.
    SimTime response_timeout(const Mode& response) const { return sifs + slot + response.phy_rx_start_delay; }
};

}  // namespace netsim
