// A histogram of delays: sums, minimum and maximum, and counts in bins.
//
// Each octave (factor of two) has 32 bins of equal width. So quantiles are accurate to 3 % for any
// delay, and adding a value takes a few instructions. Source of the bins: G. Tene, HdrHistogram,
// hdrhistogram.org.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "netsim/kernel/sim_time.hpp"

namespace netsim {

class DelayHistogram {
public:
    struct Bin {
        SimTime begin;
        SimTime end;  // exclusive
        std::uint64_t count = 0;
    };

    // `delay` ≥ 0.
    void add(SimTime delay) {
        const auto delay_ps = static_cast<double>(delay.ps());
        sum_ps_ += delay_ps;
        sum_of_squares_ps2_ += delay_ps * delay_ps;
        if (delay < min_) [[unlikely]] {
            min_ = delay;
        }
        if (delay > max_) [[unlikely]] {
            max_ = delay;
        }
        ++counts_[index_of(static_cast<std::uint64_t>(delay.ps()))];
    }

    std::uint64_t count() const;
    double sum_s() const { return sum_ps_ / 1e12; }
    double sum_of_squares_s2() const { return sum_of_squares_ps2_ / 1e24; }
    // Only when not empty.
    SimTime min() const { return min_; }
    SimTime max() const { return max_; }
    // The bins that are not empty, in rising order.
    std::vector<Bin> bins() const;

private:
    static constexpr unsigned octave_bits = 5;
    static constexpr std::uint64_t octave_bins = std::uint64_t{1} << octave_bits;
    static constexpr std::size_t bin_count = (63 - octave_bits + 1) * octave_bins;  // up to 2^63 - 1 ps
    // Delays below 2 · octave_bins picoseconds have their own bins.
    static constexpr std::size_t index_of(std::uint64_t delay_ps) {
        const auto width = static_cast<unsigned>(std::bit_width(delay_ps | octave_bins));
        const unsigned shift = width - octave_bits - 1;
        return shift * octave_bins + (delay_ps >> shift);
    }
    static constexpr SimTime begin_of(std::size_t index) {
        if (index == bin_count) {
            return SimTime::max();
        }
        const std::size_t shift = index < 2 * octave_bins ? 0 : index / octave_bins - 1;
        return SimTime::from_ps(static_cast<std::int64_t>((index - shift * octave_bins) << shift));
    }

    double sum_ps_ = 0;
    double sum_of_squares_ps2_ = 0;
    SimTime min_ = SimTime::max();
    SimTime max_;
    std::array<std::uint64_t, bin_count> counts_{};
};

}  // namespace netsim
