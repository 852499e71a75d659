// The octets of a frame on the air, for capture files. The engine itself only uses sizes.
//
// Node n has the address 02:00:00:xx:xx:xx with the lower three octets of n. All stations are in one
// independent BSS, 02:ff:ff:ff:ff:ff. The layers above LLC/SNAP are in mac/datagram_octets.hpp.
//
// Source: IEEE 802.11-2020, 9.3 (frames); RFC 1042 (LLC/SNAP).
#pragma once

#include "netsim/mac/frame.hpp"
#include "netsim/trace/octets.hpp"

namespace netsim {

// Appends the frame from its frame control field to its FCS: frame.psdu_bytes octets. If the frame
// is not intact, all bits of its FCS are inverted.
void append_frame(Octets& octets, const Frame& frame, bool intact);

}  // namespace netsim
