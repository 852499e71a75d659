#include "netsim/node/processing_time.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace netsim {

// Source: G. E. P. Box, M. E. Muller, "A note on the generation of random normal deviates", Annals
// of Mathematical Statistics 29, 1958.
SimTime ProcessingTime::draw() {
    constexpr double longest_s = 1e6;
    if (spread_ == 0) {
        return SimTime::from_seconds(median_s_);
    }
    const double radius = std::sqrt(-2 * std::log(1 - stream_.uniform()));
    const double angle = 2 * std::numbers::pi * stream_.uniform();
    const double time_s = median_s_ * std::exp(spread_ * radius * std::cos(angle));
    return SimTime::from_seconds(std::min(time_s, longest_s));
}

}  // namespace netsim
