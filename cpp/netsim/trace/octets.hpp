// Integers as octets in both byte orders: radiotap and 802.11 are little-endian, Internet protocols
// big-endian.
#pragma once

#include <cstdint>
#include <vector>

namespace netsim {

using Octets = std::vector<std::uint8_t>;

inline void append_u8(Octets& octets, unsigned value) {
    octets.push_back(static_cast<std::uint8_t>(value));
}

inline void append_le16(Octets& octets, unsigned value) {
    append_u8(octets, value);
    append_u8(octets, value >> 8);
}

inline void append_le32(Octets& octets, std::uint32_t value) {
    append_le16(octets, value);
    append_le16(octets, value >> 16);
}

inline void append_be16(Octets& octets, unsigned value) {
    append_u8(octets, value >> 8);
    append_u8(octets, value);
}

inline void append_be32(Octets& octets, std::uint32_t value) {
    append_be16(octets, value >> 16);
    append_be16(octets, value);
}

}  // namespace netsim
