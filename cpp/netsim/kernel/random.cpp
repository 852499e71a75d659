#include "netsim/kernel/random.hpp"

#include <utility>

#include "netsim/error.hpp"

namespace netsim {

std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key) {
    constexpr std::uint64_t multiplier_0 = 0xD2511F53;
    constexpr std::uint64_t multiplier_1 = 0xCD9E8D57;
    constexpr std::uint32_t weyl_0 = 0x9E3779B9;  // golden ratio − 1
    constexpr std::uint32_t weyl_1 = 0xBB67AE85;  // sqrt(3) − 1
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t product_0 = multiplier_0 * counter[0];
        const std::uint64_t product_1 = multiplier_1 * counter[2];
        counter = {static_cast<std::uint32_t>(product_1 >> 32) ^ counter[1] ^ key[0],
                   static_cast<std::uint32_t>(product_1),
                   static_cast<std::uint32_t>(product_0 >> 32) ^ counter[3] ^ key[1],
                   static_cast<std::uint32_t>(product_0)};
        key[0] += weyl_0;
        key[1] += weyl_1;
    }
    return counter;
}

RandomStream::RandomStream(std::uint64_t seed, std::uint32_t node, Purpose purpose)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      node_(node),
      purpose_(purpose) {}

std::array<std::uint32_t, RandomStream::words_of_block> RandomStream::block(std::uint64_t number) const {
    return philox4x32({static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32), node_,
                       static_cast<std::uint32_t>(purpose_)},
                      key_);
}

std::uint32_t RandomStream::next_u32() {
    const std::uint64_t word = next_word_++;
    return block(word / words_of_block)[word % words_of_block];
}

double RandomStream::uniform() {
    const std::uint64_t word = std::exchange(next_word_, next_word_ + words_of_uniform);
    const std::uint64_t first = word % words_of_block;
    const auto words = block(word / words_of_block);
    const bool is_in_one_block = first + 1 < words_of_block;
    return uniform_of(words[first],
                      is_in_one_block ? words[first + 1] : block(word / words_of_block + 1).front());
}

std::uint32_t RandomStream::uniform_int(std::uint32_t count) {
    NETSIM_ASSERT(count > 0);
    // The top 32 bits of draw · count, redrawing in the short first interval.
    // Source: D. Lemire, "Fast random integer generation in an interval", ACM TOMACS 29, 2019.
    const std::uint32_t threshold = (0U - count) % count;
    for (;;) {
        const std::uint64_t product = static_cast<std::uint64_t>(next_u32()) * count;
        if (static_cast<std::uint32_t>(product) >= threshold) {
            return static_cast<std::uint32_t>(product >> 32);
        }
    }
}

}  // namespace netsim
