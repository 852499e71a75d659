#include "netsim/mobility/gauss_markov.hpp"

#include <cmath>
#include <numbers>

namespace netsim {

GaussMarkov::GaussMarkov(RandomStream stream, Position deviations, double correlation_time_s,
                         double interval_s)
    : stream_(stream),
      deviations_(deviations),
      interval_s_(interval_s),
      kept_(std::exp(-interval_s / correlation_time_s)),
      added_(std::sqrt(1 - kept_ * kept_)),
      before_(draw()),
      after_(next()) {}

Position GaussMarkov::at(double time_s) {
    const double intervals = time_s / interval_s_;
    const auto number = static_cast<std::int64_t>(intervals);
    while (number_ < number) {
        ++number_;
        before_ = after_;
        after_ = next();
    }
    const double share = intervals - static_cast<double>(number);
    return {deviations_.x * (before_.x + share * (after_.x - before_.x)),
            deviations_.y * (before_.y + share * (after_.y - before_.y)),
            deviations_.z * (before_.z + share * (after_.z - before_.z))};
}

Position GaussMarkov::next() {
    return kept_ * before_ + added_ * draw();
}

// Source: G. E. P. Box, M. E. Muller, "A note on the generation of random normal deviates", Annals
// of Mathematical Statistics 29, 1958.
Position GaussMarkov::draw() {
    const double radius = std::sqrt(-2 * std::log(1 - stream_.uniform()));
    const double angle = 2 * std::numbers::pi * stream_.uniform();
    const double second_radius = std::sqrt(-2 * std::log(1 - stream_.uniform()));
    const double second_angle = 2 * std::numbers::pi * stream_.uniform();
    return {radius * std::cos(angle), radius * std::sin(angle), second_radius * std::cos(second_angle)};
}

}  // namespace netsim
