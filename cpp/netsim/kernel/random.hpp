// Named random streams from a counter-based generator.
//
// A stream is named by (seed of the run, node, purpose). The name is part of the generator's key
// and counter, so streams never overlap, and a tenth node does not change the draws of the first
// nine. The engine has its own distributions, so that results are equal on every platform.
//
// Source: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, "Parallel random numbers: as easy as
// 1, 2, 3", SC 2011.
#pragma once

#include <array>
#include <cstdint>

namespace netsim {

// What a stream is used for. Results depend on these values: never change one, only add. The values
// that Python uses are also in gradysim.encapsulator.random_stream.
enum class Purpose : std::uint32_t {
    backoff = 1,
    reception = 2,
    protocol = 3,
    fading = 4,
    csma_backoff = 5,
    rate_control = 6,
    parameter = 7,  // of a scenario; used by Python only
    shadowing = 8,  // beside a path loss; LogNormalShadowing draws from `fading`
    gusts = 9,
    position_error = 10,
    processing = 11,
    other_systems = 12,
};

// Philox4x32 with 10 rounds: maps a 128-bit counter and a 64-bit key to 128 random bits.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key);

// Uniform in [0, 1), from 27 bits of the high word and 26 of the low word.
inline double uniform_of(std::uint32_t high_word, std::uint32_t low_word) {
    return static_cast<double>((std::uint64_t{high_word >> 5} << 26) | (low_word >> 6)) * 0x1p-53;
}

class RandomStream {
public:
    RandomStream(std::uint64_t seed, std::uint32_t node, Purpose purpose);
    // The stream after `uniforms_drawn` draws of `uniform`.
    RandomStream(std::uint64_t seed, std::uint32_t node, Purpose purpose, std::uint64_t uniforms_drawn)
        : RandomStream(seed, node, purpose) {
        next_word_ = words_of_uniform * uniforms_drawn;
    }

    std::uint32_t next_u32();
    // Uniform in [0, 1), 53 random bits.
    double uniform();
    // Uniform between two bounds, as Python's random.uniform computes it.
    double uniform(double from, double to) { return from + (to - from) * uniform(); }
    // Uniform among 0 … count − 1, without bias. count > 0.
    std::uint32_t uniform_int(std::uint32_t count);

private:
    static constexpr unsigned words_of_uniform = 2;
    static constexpr unsigned words_of_block = 4;

    std::array<std::uint32_t, words_of_block> block(std::uint64_t number) const;

    // Each draw recomputes its block. Every node has several streams, so storing the blocks would
    // cost more in a large network.
    std::array<std::uint32_t, 2> key_;
    std::uint32_t node_;
    Purpose purpose_;
    std::uint64_t next_word_ = 0;
};

}  // namespace netsim
