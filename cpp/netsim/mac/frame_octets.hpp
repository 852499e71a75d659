// The octets of a frame as they would be on the air: only capture files need them, the engine works with sizes.
//
// Node n is 02:00:00:xx:xx:xx and 10.x.x.x, the x being the three octets of n; both ends of a message use UDP port
// 50000, and a broadcast goes to 255.255.255.255. All stations are of one independent BSS, 02:ff:ff:ff:ff:ff.
//
// Source: IEEE 802.11-2020, 9.3 (frames); RFC 1042 (LLC/SNAP); RFC 791 (IPv4); RFC 768 (UDP).
#pragma once

#include "netsim/mac/frame.hpp"
#include "netsim/trace/octets.hpp"

namespace netsim {

inline constexpr unsigned udp_port = 50'000;

// Appends the frame from its frame control field to its FCS: frame.psdu_bytes octets. The FCS of a frame that is
// not intact has all its bits inverted; the rest of the frame is what was sent.
void append_frame(Octets& octets, const Frame& frame, bool intact);

}  // namespace netsim
