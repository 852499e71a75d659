#include "netsim/phy/antenna.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "netsim/config/check.hpp"
#include "netsim/units.hpp"

namespace netsim {

namespace {

constexpr double pi = std::numbers::pi;

// In rad, 0 … π.
double angle_from_boresight(const Position& direction) {
    return std::atan2(std::hypot(direction.y, direction.z), direction.x);
}

class ConstantGain final : public AntennaPattern {
public:
    explicit ConstantGain(double gain) : gain_(gain) {}

    double gain(const Position&) const override { return gain_; }
    double max_gain() const override { return gain_; }

private:
    double gain_;
};

class Dipole final : public AntennaPattern {
public:
    // `electrical_length`: k l, in radians; at most 2π, so that there is one lobe, perpendicular to
    // the wire.
    Dipole(const Position& wire, double electrical_length)
        : wire_(wire), half_length_(electrical_length / 2), across_(intensity(0, 1)) {
        // The mean over all directions is half the integral over cos θ: Simpson's rule.
        constexpr int steps = 512;
        double sum = 0;
        for (int i = 0; i <= steps; ++i) {
            const double cosine = static_cast<double>(i) / steps;
            const double weight = i == 0 || i == steps ? 1 : (i % 2 == 1 ? 4 : 2);
            sum += weight * intensity(cosine, (1 - cosine) * (1 + cosine));
        }
        directivity_ = across_ / (sum / (3 * steps));
    }

    double gain(const Position& direction) const override {
        const double squared = dot_product(direction, direction);
        const double along = dot_product(direction, wire_);
        const Position across = direction - wire_ * along;
        const double squared_sine = dot_product(across, across) / squared;
        // Rounding must not make the gain exceed max_gain().
        return directivity_ * std::min(intensity(along / std::sqrt(squared), squared_sine) / across_, 1.0);
    }
    double max_gain() const override { return directivity_; }

private:
    // F(θ) up to a factor. The difference of cosines is written as a product, for precision with
    // short wires.
    double intensity(double cosine, double squared_sine) const {
        constexpr double short_rad = 1e-4;
        if (half_length_ < short_rad || squared_sine == 0) {
            return squared_sine;
        }
        const double difference =
            2 * std::sin(half_length_ * (1 + cosine) / 2) * std::sin(half_length_ * (1 - cosine) / 2);
        return difference * difference / squared_sine;
    }

    Position wire_;
    double half_length_;  // ½ k l
    double across_;
    double directivity_ = 1;
};

class Cosine final : public AntennaPattern {
public:
    Cosine(double max_gain, double beam_width_rad)
        : max_gain_(max_gain), exponent_(-std::log(2) / std::log(std::cos(beam_width_rad / 4))) {}

    double gain(const Position& direction) const override {
        const double cosine = std::cos(angle_from_boresight(direction) / 2);
        return max_gain_ * std::pow(std::max(cosine, 0.0), exponent_);
    }
    double max_gain() const override { return max_gain_; }

private:
    double max_gain_;
    double exponent_;
};

class Parabolic final : public AntennaPattern {
public:
    Parabolic(double max_gain, double min_gain, double beam_width_rad)
        : max_gain_(max_gain), min_gain_(min_gain), beam_width_rad_(beam_width_rad) {}

    double gain(const Position& direction) const override {
        const double share = angle_from_boresight(direction) / beam_width_rad_;
        return std::max(max_gain_ * ratio_from_db(-12 * share * share), min_gain_);
    }
    double max_gain() const override { return max_gain_; }

private:
    double max_gain_;
    double min_gain_;
    double beam_width_rad_;
};

Position axis(const std::string& name) {
    if (name == "x") {
        return {1, 0, 0};
    }
    return name == "y" ? Position{0, 1, 0} : Position{0, 0, 1};
}

using Pattern = std::unique_ptr<const AntennaPattern>;

constexpr Factory<Pattern (*)(const AntennaConfig&, double carrier_hz)> factories[] = {
    {"IsotropicAntenna", [](const AntennaConfig&, double) { return Pattern(); }},
    {"ConstantGainAntenna",
     [](const AntennaConfig& config, double) -> Pattern {
         return std::make_unique<ConstantGain>(config.gain);
     }},
    {"DipoleAntenna",
     [](const AntennaConfig& config, double carrier_hz) -> Pattern {
         const double wave_number = 2 * pi * carrier_hz / speed_of_light_mps;
         return std::make_unique<Dipole>(axis(config.wire_axis), wave_number * config.length_m);
     }},
    {"CosineAntenna",
     [](const AntennaConfig& config, double) -> Pattern {
         return std::make_unique<Cosine>(config.max_gain, config.beam_width_rad);
     }},
    {"ParabolicAntenna",
     [](const AntennaConfig& config, double) -> Pattern {
         return std::make_unique<Parabolic>(config.max_gain, config.min_gain, config.beam_width_rad);
     }},
};
static_assert(makes_all(factories, antenna_models));

}  // namespace

std::unique_ptr<const AntennaPattern> make_antenna(const AntennaConfig& config, double carrier_hz) {
    check_name("antenna.typename", config.type_name, antenna_type_names);
    return factory_of(config.type_name, factories)(config, carrier_hz);
}

}  // namespace netsim
