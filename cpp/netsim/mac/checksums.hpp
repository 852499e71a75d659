// The checksums in the octets of a frame.
#pragma once

#include <cstdint>
#include <span>

namespace netsim {

// CRC-32 of IEEE 802.11-2020, 9.2.4.8 (and of Ethernet); goes into the frame with its low octet
// first.
std::uint32_t frame_check_sequence(std::span<const std::uint8_t> octets);

// CRC-16 of IEEE Std 802.15.4-2006, 7.2.1.9 (known as CRC-16/KERMIT); goes into the frame with its
// low octet first.
std::uint16_t narrowband_check_sequence(std::span<const std::uint8_t> octets);

// The checksum of IPv4 headers and UDP datagrams, RFC 1071; goes into the header with its high
// octet first. The result is 0 for octets that contain their checksum.
std::uint16_t internet_checksum(std::span<const std::uint8_t> octets);

}  // namespace netsim
