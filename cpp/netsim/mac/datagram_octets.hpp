// The octets of the IP datagram in a data frame, for capture files. The engine itself only uses
// sizes.
//
// Node n has the address 10.x.x.x with the lower three octets of n. A broadcast goes to
// 255.255.255.255.
// Both ends use UDP port 50000.
//
// Source: RFC 791 (IPv4); RFC 768 (UDP).
#pragma once

#include "netsim/mac/frame.hpp"
#include "netsim/trace/octets.hpp"

namespace netsim {

inline constexpr unsigned udp_port = 50'000;

// Appends IPv4 header, UDP header and payload of a data frame.
void append_datagram(Octets& octets, const Frame& frame);

}  // namespace netsim
