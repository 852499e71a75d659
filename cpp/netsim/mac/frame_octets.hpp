// The octets of a frame as they would be on the air: only capture files need them, the engine works with sizes.
//
// Node n is 02:00:00:xx:xx:xx, the x being the three octets of n. All stations are of one independent BSS,
// 02:ff:ff:ff:ff:ff. What is above LLC/SNAP is in mac/datagram_octets.hpp.
//
// Source: IEEE 802.11-2020, 9.3 (frames); RFC 1042 (LLC/SNAP).
#pragma once

#include "netsim/mac/frame.hpp"
#include "netsim/trace/octets.hpp"

namespace netsim {

// Appends the frame from its frame control field to its FCS: frame.psdu_bytes octets. The FCS of a frame that is
// not intact has all its bits inverted; the rest of the frame is what was sent.
void append_frame(Octets& octets, const Frame& frame, bool intact);

}  // namespace netsim
