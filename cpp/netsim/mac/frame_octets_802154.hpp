// The octets of an 802.15.4 frame on the air, for capture files.
//
// Node n has the short address n (its lower 16 bits) in PAN 1. mac/frame_802154.hpp explains why
// there is no source address.
//
// Source: IEEE Std 802.15.4-2006, 7.2.
#pragma once

#include "netsim/mac/frame.hpp"
#include "netsim/trace/octets.hpp"

namespace netsim {

// Like append_frame (mac/frame_octets.hpp).
void append_narrowband_frame(Octets& octets, const Frame& frame, bool intact);

}  // namespace netsim
