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

// Appends the frame from its frame control field to its FCS: frame.psdu_bytes octets. If the frame
// is not intact, all bits of its FCS are inverted; the rest is as sent.
void append_narrowband_frame(Octets& octets, const Frame& frame, bool intact);

}  // namespace netsim
