#include "netsim/mac/checksums.hpp"

#include <array>
#include <cstddef>

namespace netsim {

namespace {

// The remainder of each octet, with reversed bits: the least significant bit is sent first.
constexpr std::array<std::uint32_t, 256> remainders = [] {
    constexpr std::uint32_t polynomial = 0xedb88320;
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t octet = 0; octet < table.size(); ++octet) {
        std::uint32_t remainder = octet;
        for (int bit = 0; bit < 8; ++bit) {
            remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? polynomial : 0);
        }
        table[octet] = remainder;
    }
    return table;
}();

}  // namespace

std::uint32_t frame_check_sequence(std::span<const std::uint8_t> octets) {
    std::uint32_t remainder = ~std::uint32_t{0};
    for (const std::uint8_t octet : octets) {
        remainder = (remainder >> 8) ^ remainders[(remainder ^ octet) & 0xff];
    }
    return ~remainder;
}

// Bit by bit: frames are short, and only capture files need it.
std::uint16_t narrowband_check_sequence(std::span<const std::uint8_t> octets) {
    constexpr std::uint32_t polynomial = 0x8408;  // reversed bits, as above
    std::uint32_t remainder = 0;
    for (const std::uint8_t octet : octets) {
        remainder ^= octet;
        for (int bit = 0; bit < 8; ++bit) {
            remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? polynomial : 0);
        }
    }
    return static_cast<std::uint16_t>(remainder);
}

std::uint16_t internet_checksum(std::span<const std::uint8_t> octets) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < octets.size(); ++i) {
        sum += i % 2 == 0 ? std::uint64_t{octets[i]} << 8 : octets[i];
    }
    while (sum > 0xffff) {
        sum = (sum & 0xffff) + (sum >> 16);
    }
    return static_cast<std::uint16_t>(~sum);
}

}  // namespace netsim
