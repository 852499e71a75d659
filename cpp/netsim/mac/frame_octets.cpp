#include "netsim/mac/frame_octets.hpp"

#include <cstddef>
#include <span>

#include "netsim/error.hpp"
#include "netsim/mac/checksums.hpp"
#include "netsim/mac/datagram_octets.hpp"

namespace netsim {

namespace {

constexpr unsigned data_type = 0x08;
constexpr unsigned ack_type = 0xd4;
constexpr unsigned rts_type = 0xb4;
constexpr unsigned cts_type = 0xc4;
constexpr unsigned retry_flag = 0x08;

void append_frame_control(Octets& octets, const Frame& frame, unsigned type) {
    append_u8(octets, type);
    append_u8(octets, frame.retry ? retry_flag : 0);
}

// In microseconds, rounded up; at most 32767 (the standard's limit).
void append_duration(Octets& octets, SimTime duration) {
    constexpr std::int64_t ps_per_us = 1'000'000;
    const std::int64_t us = (duration.ps() + ps_per_us - 1) / ps_per_us;
    append_le16(octets, static_cast<unsigned>(us < 32'767 ? us : 32'767));
}

void append_mac_address(Octets& octets, NodeId node) {
    if (node == broadcast_id) {
        append_be32(octets, 0xffffffff);
        append_be16(octets, 0xffff);
        return;
    }
    append_be16(octets, 0x0200);
    append_be32(octets, static_cast<std::uint32_t>(node) & 0xffffff);
}

void append_bss(Octets& octets) {
    append_be16(octets, 0x02ff);
    append_be32(octets, 0xffffffff);
}

void append_sequence_control(Octets& octets, const Frame& frame) {
    append_le16(octets, (frame.sequence & 0xfff) << 4);  // fragment number 0
}

void append_llc_snap(Octets& octets) {
    append_be16(octets, 0xaaaa);
    append_be32(octets, 0x03000000);
    append_be16(octets, 0x0800);  // IPv4
}

void append_data(Octets& octets, const Frame& frame) {
    append_frame_control(octets, frame, data_type);
    append_duration(octets, frame.duration_field);
    append_mac_address(octets, frame.receiver);
    append_mac_address(octets, frame.transmitter);
    append_bss(octets);
    append_sequence_control(octets, frame);
    append_llc_snap(octets);
    append_datagram(octets, frame);
}

void append_ack(Octets& octets, const Frame& frame) {
    append_frame_control(octets, frame, ack_type);
    append_duration(octets, frame.duration_field);
    append_mac_address(octets, frame.receiver);
}

void append_rts(Octets& octets, const Frame& frame) {
    append_frame_control(octets, frame, rts_type);
    append_duration(octets, frame.duration_field);
    append_mac_address(octets, frame.receiver);
    append_mac_address(octets, frame.transmitter);
}

void append_cts(Octets& octets, const Frame& frame) {
    append_frame_control(octets, frame, cts_type);
    append_duration(octets, frame.duration_field);
    append_mac_address(octets, frame.receiver);
}

}  // namespace

void append_frame(Octets& octets, const Frame& frame, bool intact) {
    const std::size_t start = octets.size();
    switch (frame.kind) {
        case FrameKind::broadcast:
        case FrameKind::unicast:
            append_data(octets, frame);
            break;
        case FrameKind::ack:
            append_ack(octets, frame);
            break;
        case FrameKind::rts:
            append_rts(octets, frame);
            break;
        case FrameKind::cts:
            append_cts(octets, frame);
            break;
    }
    const std::uint32_t fcs = frame_check_sequence(std::span(octets).subspan(start));
    append_le32(octets, intact ? fcs : ~fcs);
    NETSIM_ASSERT(octets.size() - start == static_cast<std::size_t>(frame.psdu_bytes));
}

}  // namespace netsim
