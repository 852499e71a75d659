#include "netsim/medium/fading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "netsim/units.hpp"

namespace netsim {

namespace {

// Exceeded once in 10⁹ draws of a standard normal number.
constexpr double rare_normal = 5.9978070150076869;
// And by the power of a complex Gaussian of mean power 1, which is exponentially distributed: 9 ln 10.
constexpr double rare_scattered = 9 * std::numbers::ln10;

}  // namespace

Fading::Fading(const MediumConfig& config, std::uint64_t seed)
    : gaussians_(seed, SimTime::from_seconds(config.coherence_time())) {
    double farthest = 0;  // from 0, of the pairs that are not cut off
    if (config.path_loss == "LogNormalShadowing") {
        kind_ = Kind::log_normal;
        sigma_ = config.sigma_db * std::numbers::ln10 / 10;
        farthest = rare_normal;
    } else if (config.path_loss == "RayleighFading" || config.path_loss == "RicianFading") {
        kind_ = Kind::rician;
        k_ = config.path_loss == "RicianFading" ? ratio_from_db(config.k_db) : 0;
        farthest = std::sqrt(2 * rare_scattered);
    } else if (config.path_loss == "NakagamiFading") {
        kind_ = Kind::nakagami;
        shape_ = config.shape_factor;
        if (shape_ != 1) {
            gamma_.emplace(shape_);
        }
        farthest = rare_normal;
    } else {
        return;
    }
    // All rise with the first number, and none has more of two numbers than of one at the same distance from 0.
    const auto most_gain = [this](double from_0) { return untruncated({from_0, 0}); };
    most_ = most_gain(farthest);
    rare_ = RareGains(most_gain, farthest);
}

double Fading::gain(std::uint32_t a, std::uint32_t b, SimTime time, std::uint64_t transmission,
                    double least) const {
    if (kind_ == Kind::none) {
        return 1;
    }
    const auto normal = gaussians_.at_if_beyond(rare_.chance_beyond(least), a, b, time, transmission);
    return normal ? std::min(untruncated(*normal), most_) : 0;
}

double Fading::untruncated(const GaussianPair& normal) const {
    switch (kind_) {
        case Kind::log_normal:
            return std::exp(sigma_ * normal.first);
        case Kind::rician: {
            const double in_phase = normal.first + std::sqrt(2 * k_);
            return (in_phase * in_phase + normal.second * normal.second) / (2 * (k_ + 1));
        }
        case Kind::nakagami:
            return gamma_ ? gamma_->quantile_of_normal(normal.first) / shape_
                          : -std::log(std::erfc(normal.first / std::numbers::sqrt2) / 2);
        case Kind::none:
            break;
    }
    return 1;
}

}  // namespace netsim
