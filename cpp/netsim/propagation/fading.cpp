#include "netsim/propagation/fading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>

#include "netsim/units.hpp"

namespace netsim {

namespace {

// Exceeded once in 10⁹ draws of a standard normal number.
constexpr double rare_normal = 5.9978070150076869;
// The same for the power of a complex Gaussian of mean power 1, which is exponentially distributed:
// 9 ln 10.
constexpr double rare_scattered = 9 * std::numbers::ln10;

double normal_density(double x) {
    return std::exp(-x * x / 2) * (std::numbers::inv_sqrtpi / std::numbers::sqrt2);
}

// The probability that a standard normal number is at least `x`.
double normal_above(double x) {
    return std::erfc(x / std::numbers::sqrt2) / 2;
}

// The probability that a pair of standard normal numbers is within `radius` of (−line, 0). The
// integral runs over the chords of that disc, at height r sin θ and half as long as r cos θ: the
// density of the height times the probability of lying between the chord's ends. As a function of
// θ, it is smooth and periodic, so a few equal steps give many digits.
double chance_within(double radius, double line) {
    constexpr int steps = 16;
    constexpr double far = 8;  // no pair is that high
    const double width =
        (radius > far ? std::asin(far / radius) : std::numbers::pi / 2) / static_cast<double>(steps);
    double sum = 0;
    for (int step = 0; step < steps; ++step) {
        const double angle = width * (step + 0.5);
        const double half_chord = radius * std::cos(angle);
        sum += normal_density(radius * std::sin(angle)) * half_chord *
               (normal_above(line - half_chord) - normal_above(line + half_chord));
    }
    return 2 * width * sum;  // above and below the center
}

}  // namespace

Fading::Fading(const MediumConfig& config, std::uint64_t seed)
    : gaussians_(seed, Purpose::fading, SimTime::from_seconds(config.coherence_time())) {
    using Set = void (*)(Fading&, const MediumConfig&);
    constexpr Factory<Set> factories[] = {
        {"LogNormalShadowing",
         [](Fading& made, const MediumConfig& of) { made.set_log_normal(of.sigma_db); }},
        {"RayleighFading", [](Fading& made, const MediumConfig&) { made.set_rician(0); }},
        {"RicianFading",
         [](Fading& made, const MediumConfig& of) { made.set_rician(ratio_from_db(of.k_db)); }},
        {"NakagamiFading", [](Fading& made, const MediumConfig& of) { made.set_nakagami(of.shape_factor); }},
    };
    static_assert(makes_all(factories, path_losses | std::views::filter(is_random)));
    const Model& model = model_named(config.path_loss, path_losses);
    if (is_random(model)) {
        factory_of(model.name, factories)(*this, config);
    }
}

Fading Fading::shadowing(const MediumConfig& config, std::uint64_t seed) {
    Fading shadowing(LinkGaussians(seed, Purpose::shadowing,
                                   SimTime::from_seconds(config.shadowing_decorrelation_time_s)));
    shadowing.set_log_normal(config.shadowing_standard_deviation_db);
    return shadowing;
}

void Fading::set_log_normal(double sigma_db) {
    if (sigma_db > 0) {
        kind_ = Kind::log_normal;
        sigma_ = sigma_db * std::numbers::ln10 / 10;
        cut_off(rare_normal);
    }
}

void Fading::set_rician(double k) {
    kind_ = Kind::rician;
    k_ = k;
    cut_off(std::sqrt(2 * rare_scattered));
}

void Fading::set_nakagami(double shape) {
    kind_ = Kind::nakagami;
    shape_ = shape;
    if (shape_ != 1) {
        gamma_.emplace(shape_);
    }
    cut_off(rare_normal);
}

void Fading::cut_off(double farthest) {
    // All models rise with the first number. At equal distance from 0, the largest gain has a
    // second number of 0.
    const auto max_gain = [this](double from_0) { return untruncated({from_0, 0}); };
    max_ = max_gain(farthest);
    tail_bound_ = GainTailBound(max_gain, farthest);
}

double Fading::gain(std::uint32_t a, std::uint32_t b, SimTime time, std::uint64_t transmission,
                    double least) const {
    if (kind_ == Kind::none) {
        return 1;
    }
    const auto normal = gaussians_.at_if_beyond(tail_bound_.chance_beyond(least), a, b, time, transmission);
    return normal ? std::min(untruncated(*normal), max_) : 0;
}

double Fading::chance_of(double gain) const {
    if (gain > max_) {
        return 0;
    }
    switch (kind_) {
        case Kind::log_normal:
            return normal_above(std::log(gain) / sigma_);
        case Kind::rician:
            return k_ > 0 ? 1 - chance_within(std::sqrt(2 * (k_ + 1) * gain), std::sqrt(2 * k_))
                          : std::exp(-gain);
        case Kind::nakagami:
            return gamma_ ? gamma_->distribution().above(shape_ * gain) : std::exp(-gain);
        case Kind::none:
            break;
    }
    return 1;
}

double Fading::mean() const {
    // All means are 1 except this one, where the cut-off matters if sigma is large.
    return kind_ == Kind::log_normal ? std::exp(sigma_ * sigma_ / 2) * normal_above(sigma_ - rare_normal) +
                                           max_ * normal_above(rare_normal)
                                     : 1;
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
            return gamma_ ? gamma_->of_normal(normal.first) / shape_
                          : -std::log(std::erfc(normal.first / std::numbers::sqrt2) / 2);
        case Kind::none:
            break;
    }
    return 1;
}

}  // namespace netsim
