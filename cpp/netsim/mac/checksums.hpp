// The checksums in the octets of a frame.
#pragma once

#include <cstdint>
#include <span>

namespace netsim {

// CRC-32 of IEEE 802.11-2020, 9.2.4.8 (and of Ethernet). In the frame, its low octet comes first.
std::uint32_t frame_check_sequence(std::span<const std::uint8_t> octets);

// CRC-16 of IEEE Std 802.15.4-2006, 7.2.1.9 (known as CRC-16/KERMIT). In the frame, its low octet
// comes first.
std::uint16_t narrowband_check_sequence(std::span<const std::uint8_t> octets);

// The checksum of IPv4 headers and UDP datagrams, RFC 1071. In the header, its high octet comes
// first. Returns 0 for octets that contain their valid checksum.
std::uint16_t internet_checksum(std::span<const std::uint8_t> octets);

}  // namespace netsim
