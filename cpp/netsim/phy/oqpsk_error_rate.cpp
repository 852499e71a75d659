#include "netsim/phy/oqpsk_error_rate.hpp"

#include <algorithm>
#include <cmath>

#include "netsim/error.hpp"
#include "netsim/phy/modes.hpp"

namespace netsim {

double OqpskErrorModel::bit_error_rate(double snir) {
    NETSIM_ASSERT(snir >= 0);
    // Above this, the bit error rate, dominated by k = 2, is below 1e-16. Even over the longest
    // frame, the success probability rounds to 1.
    constexpr double negligible_from = 4;
    if (snir > negligible_from) {
        return 0;
    }
    constexpr int order = 16;
    double choose = order;  // (16 choose k)
    double sum = 0;
    for (int k = 2; k <= order; ++k) {
        choose = choose * (order + 1 - k) / k;
        const double term = choose * std::exp(20 * snir * (1.0 / k - 1));
        sum += k % 2 == 0 ? term : -term;
    }
    return std::clamp(8.0 / 15 / 16 * sum, 0.0, 0.5);
}

double OqpskErrorModel::success_probability(const Mode& mode, double snir, int psdu_bytes) const {
    NETSIM_ASSERT(mode.family == ModeFamily::oqpsk);
    const auto bits = static_cast<double>(mode.header_bits + mode.data_bits(psdu_bytes));
    return std::exp(bits * std::log1p(-bit_error_rate(snir)));
}

}  // namespace netsim
