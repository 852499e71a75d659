// A bound for the tail of a fading gain: how far from 0 a pair of Gaussian numbers must be to reach
// a gain. Pairs nearer to 0 need not be computed.
//
// Most receivers within the largest reach of a faded signal are so far away that only a rare gain
// would let them notice it. The distance of a pair from 0 is known before the pair
// (link_gaussians.hpp), and is usually too small.
//
// A distance r from 0 is expressed as the probability that a pair is farther away, exp(−r² / 2).
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace netsim {

class GainTailBound {
public:
    // Excludes no gain.
    GainTailBound() = default;
    // `max_gain(r)`: the largest gain of the pairs up to r away from 0, for 0 … `farthest`; must
    // not fall with r.
    template <typename MostGain>
    GainTailBound(const MostGain& max_gain, double farthest);

    // The probability that stands for a distance from 0 up to which no pair has that gain. For
    // gains larger than all: that of `farthest` or less.
    double chance_beyond(double gain) const {
        if (!(gain >= first_)) {
            return 1;
        }
        return chances_[std::min<std::size_t>(step_of(gain) - step_of(first_), chances_.size() - 1)];
    }

private:
    // A step is the exponent of a number and its first mantissa bits: four steps per doubling.
    static constexpr int bits_in_step = 50;
    static std::uint64_t step_of(double gain) { return std::bit_cast<std::uint64_t>(gain) >> bits_in_step; }
    static double start_of(std::uint64_t step) { return std::bit_cast<double>(step << bits_in_step); }

    // Smaller gains are too common to gain from the bound: one in 65 of Rayleigh's gains is below
    // this.
    double first_ = 1.0 / 64;
    std::vector<double> chances_{1};  // [step], from that of `first_` on
};

template <typename MostGain>
GainTailBound::GainTailBound(const MostGain& max_gain, double farthest) {
    chances_.clear();
    first_ = std::max(first_, max_gain(0));
    const std::uint64_t last_step = step_of(std::max(first_, max_gain(farthest)));
    for (std::uint64_t step = step_of(first_); step <= last_step; ++step) {
        double without = 0;  // no pair up to here has the gain
        double with = farthest;
        for (int halving = 0; halving < 50; ++halving) {
            const double middle = (without + with) / 2;
            (max_gain(middle) < start_of(step) ? without : with) = middle;
        }
        constexpr double margin = 1e-9;  // for rounding
        chances_.push_back(std::exp(-without * without / 2) * (1 + margin));
    }
}

}  // namespace netsim
