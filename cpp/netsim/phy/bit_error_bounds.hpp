// Upper and lower bounds of a bit error rate, from a table over the SNIR with 32 steps per factor of
// two.
//
// Most frames are much stronger than the interference, and most of the rest are much weaker. For
// these, the table suffices.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace netsim {

class BitErrorBounds {
public:
    // `rate_at(snir)` must be in [0, 1] and must not rise with the SNIR, a linear ratio.
    template <typename Rate>
    explicit BitErrorBounds(const Rate& rate_at) {
        for (std::size_t i = 0; i < rates_.size(); ++i) {
            rates_[i] = rate_at(std::bit_cast<double>((first_step + i) << step_shift));
        }
    }

    // An upper bound for the rate at `snir` ≥ 0 and above.
    double ceiling(double snir) const {
        const std::uint64_t step = std::bit_cast<std::uint64_t>(snir) >> step_shift;
        return step < first_step ? 1 : rates_[std::min(step - first_step, step_count - 1)];
    }
    // A lower bound for the rate at `snir` ≥ 0 and below.
    double floor(double snir) const {
        const std::uint64_t next =
            std::max((std::bit_cast<std::uint64_t>(snir) >> step_shift) + 1, first_step);
        return next > last_step ? 0 : rates_[next - first_step];
    }

private:
    // A step number is the upper bits of a double, including five of its mantissa. It rises with the
    // double.
    static constexpr int step_shift = 52 - 5;
    static constexpr std::uint64_t first_step = std::bit_cast<std::uint64_t>(0.125) >> step_shift;
    static constexpr std::uint64_t last_step = std::bit_cast<std::uint64_t>(2048.0) >> step_shift;
    static constexpr std::uint64_t step_count = last_step - first_step + 1;

    std::array<double, step_count> rates_{};  // at the lower ends of the steps
};

}  // namespace netsim
