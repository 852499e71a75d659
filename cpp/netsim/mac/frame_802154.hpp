// The frames of the 802.15.4 MAC: their sizes, and how they use the fields of a Frame.
//
// The stack above is that of 802.11 nodes, IPv4 and UDP, but without LLC/SNAP: INET has the protocol's number in its
// MAC header, which it takes for 9 octets all the same. Those are, as the standard counts: frame control 2,
// sequence number 1, PAN 2, destination 2, FCS 2; there is no source address but that of IPv4. There is no
// fragmentation (6LoWPAN), so a message of 90 B is the longest.
//
// Of a Frame, `duration_field` is not on the air; it says here whether an ACK is asked for (more than 0). `retry` isn't,
// either: it says that the frame repeats the last one, which a receiver finds out by its sequence number.
//
// Source: IEEE Std 802.15.4-2006, 7.2.2 (formats), 7.4.1 (aMinMPDUOverhead = 9), 6.4.1 (aMaxPHYPacketSize = 127).
#pragma once

#include "netsim/mac/frame.hpp"

namespace netsim {

// Octets.
constexpr int narrowband_overhead_bytes = 9;  // MAC header and FCS
constexpr int narrowband_ack_bytes = 5;
constexpr int narrowband_longest_psdu_bytes = 127;
constexpr int narrowband_mtu_bytes = narrowband_longest_psdu_bytes - narrowband_overhead_bytes;

// Length of the PSDU that carries a payload: 90 B make 127 B.
constexpr int narrowband_psdu_bytes(int payload_bytes) {
    return narrowband_overhead_bytes + datagram_bytes(payload_bytes);
}

// Whether the sender of a data frame waits for an ACK; never that of a broadcast.
inline bool asks_for_ack(const Frame& data) {
    return data.duration_field > SimTime();
}

// The answer to `data`.
inline Frame make_narrowband_ack(const Frame& data) {
    Frame ack;
    ack.kind = FrameKind::ack;
    ack.transmitter = data.receiver;
    ack.receiver = data.transmitter;
    ack.sequence = data.sequence;
    ack.psdu_bytes = narrowband_ack_bytes;
    return ack;
}

}  // namespace netsim
