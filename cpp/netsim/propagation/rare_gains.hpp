// How far from 0 a pair of Gaussian numbers has to lie for a gain: what saves working out the pairs that lie nearer.
//
// Most receivers within the farthest that a faded signal can reach are so far away that only a rare gain would let them
// notice it. How far from 0 a pair lies is known before the pair is (link_gaussians.hpp), and is mostly not far enough.
//
// A distance r from 0 is given by the chance that a pair of standard normal numbers lies farther away, exp(−r² / 2).
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace netsim {

class RareGains {
public:
    // No gain is rare.
    RareGains() = default;
    // `most_gain(r)`: the largest one of the pairs up to r away from 0, for 0 … `farthest`; must not fall with r.
    template <typename MostGain>
    RareGains(const MostGain& most_gain, double farthest);

    // Of a distance from 0 up to which no pair has that gain. For one that is larger than all: of `farthest`, or less.
    double chance_beyond(double gain) const {
        if (!(gain >= first_)) {
            return 1;
        }
        return chances_[std::min<std::size_t>(step_of(gain) - step_of(first_), chances_.size() - 1)];
    }

private:
    // Steps are told apart by the exponent of a number and the first bits after the point: four to each doubling.
    static constexpr int bits_in_step = 50;
    static std::uint64_t step_of(double gain) { return std::bit_cast<std::uint64_t>(gain) >> bits_in_step; }
    static double start_of(std::uint64_t step) { return std::bit_cast<double>(step << bits_in_step); }

    // Less is not rare enough to be worth the question: one in 65 of Rayleigh's gains is.
    double first_ = 1.0 / 64;
    std::vector<double> chances_{1};  // [step], from that of `first_` on
};

template <typename MostGain>
RareGains::RareGains(const MostGain& most_gain, double farthest) {
    chances_.clear();
    first_ = std::max(first_, most_gain(0));
    const std::uint64_t last_step = step_of(std::max(first_, most_gain(farthest)));
    for (std::uint64_t step = step_of(first_); step <= last_step; ++step) {
        double without = 0;  // no pair up to here has the gain
        double with = farthest;
        for (int halving = 0; halving < 50; ++halving) {
            const double middle = (without + with) / 2;
            (most_gain(middle) < start_of(step) ? without : with) = middle;
        }
        constexpr double margin = 1e-9;  // for rounding
        chances_.push_back(std::exp(-without * without / 2) * (1 + margin));
    }
}

}  // namespace netsim
