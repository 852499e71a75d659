// A running 64-bit hash of a run: runs with equal fingerprints had the same observable events.
//
// It covers what a user can observe: frames on the air, their receptions, and the events of
// protocols. Internal events of the engine are not part of it, so optimizing the engine does not
// change it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace netsim {

class Fingerprint {
public:
    void add(std::uint64_t word) {
        hash_ = (hash_ ^ word) * 0x9E3779B97F4A7C15U;
        hash_ ^= hash_ >> 32;
    }
    // Adds the length, in the lowest octet of the first word, then the characters from low to high:
    // seven in the first word, eight in each following one. The last word is never full, but may be
    // empty.
    void add_text(std::string_view text) {
        constexpr std::size_t first = 7;
        if (text.size() < first) {
            add(word_of(text, 0, text.size()) << 8 ^ text.size());
            return;
        }
        add(word_of(text, 0, first) << 8 ^ text.size());
        std::size_t done = first;
        for (; text.size() - done >= 8; done += 8) {
            add(word_of(text, done, 8));
        }
        add(word_of(text, done, text.size() - done));
    }
    std::uint64_t value() const { return hash_; }

private:
    // Little-endian. Compilers turn it into one load if `count` is a constant.
    static std::uint64_t word_of(std::string_view text, std::size_t from, std::size_t count) {
        std::uint64_t word = 0;
        for (std::size_t i = 0; i < count; ++i) {
            word |= static_cast<std::uint64_t>(static_cast<unsigned char>(text[from + i])) << (8 * i);
        }
        return word;
    }

    std::uint64_t hash_ = 0x243F6A8885A308D3U;
};

}  // namespace netsim
