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
    if (config.path_loss == "LogNormalShadowing") {
        kind_ = Kind::log_normal;
        sigma_ = config.sigma_db * std::numbers::ln10 / 10;
        most_ = untruncated({rare_normal, 0});
    } else if (config.path_loss == "RayleighFading" || config.path_loss == "RicianFading") {
        kind_ = Kind::rician;
        k_ = config.path_loss == "RicianFading" ? ratio_from_db(config.k_db) : 0;
        const double amplitude = std::sqrt(k_) + std::sqrt(rare_scattered);
        most_ = amplitude * amplitude / (k_ + 1);
    } else if (config.path_loss == "NakagamiFading") {
        kind_ = Kind::nakagami;
        shape_ = config.shape_factor;
        if (shape_ != 1) {
            gamma_.emplace(shape_);
        }
        most_ = untruncated({rare_normal, 0});
    }
}

double Fading::gain(std::uint32_t a, std::uint32_t b, SimTime time, std::uint64_t transmission) const {
    if (kind_ == Kind::none) {
        return 1;
    }
    return std::min(untruncated(gaussians_.at(a, b, time, transmission)), most_);
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
