// The frames of the 802.15.4 MAC: their sizes, and how they use the fields of a Frame.
//
// The layers above are IPv4 and UDP, as for 802.11 nodes, but without LLC/SNAP: INET's MAC header
// contains the protocol number and still has 9 octets. By the standard, these are: frame control 2,
// sequence number 1, PAN 2, destination 2, FCS 2. The only source address is that of IPv4. There is
// no fragmentation (6LoWPAN), so the longest message has 90 B.
//
// Two fields of Frame are not on the air. `duration_field` is positive if an ACK is requested.
// `retry` means that the frame repeats the last one. A real receiver detects that by the sequence
// number.
//
// Source: IEEE Std 802.15.4-2006, 7.2.2 (formats), 7.4.1 (aMinMPDUOverhead = 9), 6.4.1
// (aMaxPHYPacketSize = 127).
#pragma once

#include "netsim/mac/frame.hpp"

namespace netsim {

constexpr int narrowband_overhead_bytes = 9;  // MAC header and FCS
constexpr int narrowband_ack_bytes = 5;
constexpr int narrowband_longest_psdu_bytes = 127;
constexpr int narrowband_mtu_bytes = narrowband_longest_psdu_bytes - narrowband_overhead_bytes;

// Length of the PSDU that carries a payload: 127 B for 90 B.
constexpr int narrowband_psdu_bytes(int payload_bytes) {
    return narrowband_overhead_bytes + datagram_bytes(payload_bytes);
}

// Whether the sender of a data frame waits for an ACK. False for broadcasts.
inline bool asks_for_ack(const Frame& data) {
    return data.duration_field > SimTime();
}

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
