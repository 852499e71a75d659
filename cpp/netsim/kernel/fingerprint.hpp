// A running 64-bit hash of what happened in a run: two runs with equal fingerprints took the same course.
//
// Fed with what a user could observe (frames on the air, what became of their copies, what reached a protocol), not
// with the engine's internal events, so a faster engine keeps the fingerprint of a slower one.
#pragma once

#include <cstdint>
#include <string_view>

namespace netsim {

class Fingerprint {
public:
    void add(std::uint64_t word) {
        hash_ = (hash_ ^ word) * 0x9E3779B97F4A7C15U;
        hash_ ^= hash_ >> 32;
    }
    void add_text(std::string_view text) {
        std::uint64_t word = text.size();
        unsigned shift = 8;
        for (const char character : text) {
            word ^= static_cast<std::uint64_t>(static_cast<unsigned char>(character)) << shift;
            if ((shift += 8) == 64) {
                add(word);
                word = 0;
                shift = 0;
            }
        }
        add(word);
    }
    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0x243F6A8885A308D3U;
};

}  // namespace netsim
