#include "netsim/propagation/link_gaussians.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace netsim {

LinkGaussians::Mixture LinkGaussians::mixture(std::uint32_t a, std::uint32_t b, SimTime time,
                                              std::uint64_t transmission) const {
    if (a > b) {
        std::swap(a, b);
    }
    if (coherence_time_ == SimTime{}) {
        return {.before = draw(a, b, transmission), .after = {}};
    }
    const auto index = static_cast<std::uint64_t>(time.ps() / coherence_time_.ps());
    const std::int64_t since_ps = time.ps() % coherence_time_.ps();
    if (since_ps == 0) {
        return {.before = draw(a, b, index), .after = {}};
    }
    return {.before = draw(a, b, index),
            .after = draw(a, b, index + 1),
            .share = static_cast<double>(since_ps) / static_cast<double>(coherence_time_.ps())};
}

GaussianPair LinkGaussians::Mixture::pair() const {
    const GaussianPair first = before.pair();
    if (share == 0) {
        return first;
    }
    const GaussianPair second = after.pair();
    const double angle = std::numbers::pi / 2 * share;
    const double weight_before = std::cos(angle);
    const double weight_after = std::sin(angle);
    return {weight_before * first.first + weight_after * second.first,
            weight_before * first.second + weight_after * second.second};
}

LinkGaussians::Drawn LinkGaussians::draw(std::uint32_t low, std::uint32_t high, std::uint64_t index) const {
    // A stream's key (kernel/random.hpp) has room for one node. The other node takes the place of
    // the upper half of the block index, which goes into the upper 16 bits of the purpose.
    const std::uint32_t purpose =
        static_cast<std::uint32_t>(purpose_) | (static_cast<std::uint32_t>(index >> 32) << 16);
    const auto words =
        philox4x32({static_cast<std::uint32_t>(index), low, high, purpose},
                   {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)});
    return {1 - uniform_of(words[0], words[1]), uniform_of(words[2], words[3])};
}

// Source: G. E. P. Box, M. E. Muller, "A note on the generation of random normal deviates", Annals
// of Mathematical Statistics 29, 1958.
GaussianPair LinkGaussians::Drawn::pair() const {
    const double radius = std::sqrt(-2 * std::log(chance_beyond));
    const double angle = 2 * std::numbers::pi * turn;
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace netsim
