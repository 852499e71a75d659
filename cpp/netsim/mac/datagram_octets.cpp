#include "netsim/mac/datagram_octets.hpp"

#include <cstddef>
#include <span>
#include <string>

#include "netsim/mac/checksums.hpp"

namespace netsim {

namespace {

constexpr unsigned ipv4_time_to_live = 64;
constexpr unsigned ipv4_protocol_udp = 17;
constexpr std::size_t ipv4_checksum_offset = 10;
constexpr std::size_t udp_checksum_offset = 6;

std::uint32_t ipv4_address(NodeId node) {
    return node == broadcast_id ? 0xffffffff : 10U << 24 | (static_cast<std::uint32_t>(node) & 0xffffff);
}

void set_be16(Octets& octets, std::size_t offset, unsigned value) {
    octets[offset] = static_cast<std::uint8_t>(value >> 8);
    octets[offset + 1] = static_cast<std::uint8_t>(value);
}

void append_ipv4_header(Octets& octets, const Frame& frame, std::size_t payload_bytes) {
    const std::size_t start = octets.size();
    append_be16(octets, 0x4500);  // version 4, header of five words
    append_be16(octets, static_cast<unsigned>(ipv4_header_bytes + udp_header_bytes + payload_bytes));
    append_be16(octets, frame.sequence);  // identification
    append_be16(octets, 0);               // not a fragment
    append_u8(octets, ipv4_time_to_live);
    append_u8(octets, ipv4_protocol_udp);
    append_be16(octets, 0);  // checksum, filled in below
    append_be32(octets, ipv4_address(frame.transmitter));
    append_be32(octets, ipv4_address(frame.receiver));
    set_be16(octets, start + ipv4_checksum_offset, internet_checksum(std::span(octets).subspan(start)));
}

void append_udp(Octets& octets, const Frame& frame) {
    const std::string& payload = *frame.payload;
    const std::size_t start = octets.size();
    const auto datagram_length = static_cast<unsigned>(udp_header_bytes + payload.size());
    append_be16(octets, udp_port);
    append_be16(octets, udp_port);
    append_be16(octets, datagram_length);
    append_be16(octets, 0);  // checksum, filled in below
    octets.insert(octets.end(), payload.begin(), payload.end());

    Octets covered;  // the pseudo header, then the datagram
    append_be32(covered, ipv4_address(frame.transmitter));
    append_be32(covered, ipv4_address(frame.receiver));
    append_be16(covered, ipv4_protocol_udp);
    append_be16(covered, datagram_length);
    covered.insert(covered.end(), octets.begin() + static_cast<std::ptrdiff_t>(start), octets.end());
    const unsigned checksum = internet_checksum(covered);
    set_be16(octets, start + udp_checksum_offset, checksum == 0 ? 0xffff : checksum);  // 0 means: no checksum
}

}  // namespace

void append_datagram(Octets& octets, const Frame& frame) {
    append_ipv4_header(octets, frame, frame.payload->size());
    append_udp(octets, frame);
}

}  // namespace netsim
