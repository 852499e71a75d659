// The frames of the 802.11 MAC and their sizes. 802.15.4 frames are Frames, too, with the sizes of
// mac/frame_802154.hpp.
//
// A frame is created once, never changed, and shared by all receivers. A retry is another frame,
// with its retry bit set. Source of the sizes: IEEE 802.11-2020, 9.3 (frames), RFC 1042 (LLC/SNAP),
// RFC 791 (IPv4) and RFC 768 (UDP).
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "netsim/kernel/sim_time.hpp"
#include "netsim/node_id.hpp"
#include "netsim/trace/frame_label.hpp"
#include "netsim/trace/message_outcomes.hpp"

namespace netsim {

// The content of a message in UTF-8, shared by all receivers.
using Payload = std::shared_ptr<const std::string>;

constexpr int mac_header_bytes = 24;
constexpr int fcs_bytes = 4;
constexpr int llc_snap_bytes = 8;
constexpr int ipv4_header_bytes = 20;
constexpr int udp_header_bytes = 8;
constexpr int ack_bytes = 14;
constexpr int rts_bytes = 20;
constexpr int cts_bytes = 14;

// Length of the MPDU that carries a payload: 164 B for 100 B.
constexpr int data_psdu_bytes(int payload_bytes) {
    return mac_header_bytes + llc_snap_bytes + ipv4_header_bytes + udp_header_bytes + payload_bytes +
           fcs_bytes;
}
// Length of the IP datagram, which the MTU limits.
constexpr int datagram_bytes(int payload_bytes) {
    return ipv4_header_bytes + udp_header_bytes + payload_bytes;
}

// The cause of a message: a callback of the sender's protocol, numbered by the replay recorder.
// 0: not recorded.
using CauseId = std::uint32_t;

struct Frame {
    FrameKind kind = FrameKind::broadcast;
    NodeId transmitter = 0;
    NodeId receiver = broadcast_id;
    std::uint32_t sequence = 0;  // of the transmitter's data frames; a retry keeps it
    bool retry = false;
    // Time from the end of this frame to the end of the exchange. Sets the NAV of other stations.
    SimTime duration_field{};  // NOLINT(readability-redundant-member-init): g++ warns without it
    int psdu_bytes = 0;
    Payload payload;    // of data frames only
    CauseId cause = 0;  // of data frames only
    SimTime accepted;   // of data frames only: when the interface accepted the message
};

inline MessageKind message_kind(const Frame& frame) {
    return frame.receiver == broadcast_id ? MessageKind::broadcast : MessageKind::unicast;
}

}  // namespace netsim
