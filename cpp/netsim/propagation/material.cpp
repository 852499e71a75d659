#include "netsim/propagation/material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "netsim/config/check.hpp"
#include "netsim/units.hpp"

namespace netsim {

namespace {

constexpr double pi = std::numbers::pi;
// Of the vacuum, F/m; CODATA 2018.
constexpr double vacuum_permittivity = 8.8541878128e-12;

// Relative permittivity a f^b and conductivity c f^d in S/m, f in GHz.
struct Fit {
    std::string_view name;
    double a;
    double b;
    double c;
    double d;
};

// As P.2040-3 states them: most for 1 to 100 GHz, brick and plywood to 40, marble to 60, wood and
// glass from 0.1 on.
constexpr std::array<Fit, material_names.size()> fits{{
    {"concrete", 5.24, 0, 0.0462, 0.7822},
    {"brick", 3.91, 0, 0.0238, 0.16},
    {"plasterboard", 2.73, 0, 0.0085, 0.9395},
    {"wood", 1.99, 0, 0.0047, 1.0718},
    {"glass", 6.31, 0, 0.0036, 1.3394},
    {"marble", 7.074, 0, 0.0055, 0.9262},
    {"ceilingBoard", 1.48, 0, 0.0011, 1.0750},
    {"chipboard", 2.58, 0, 0.0217, 0.7800},
    {"plywood", 2.71, 0, 0.33, 0},
    {"metal", 1, 0, 1e7, 0},
}};

}  // namespace

// The attenuation constant in Np/m is ω √(με) (½ (√(1 + (σ / ωε)²) - 1))^½: C. A. Balanis,
// "Advanced Engineering Electromagnetics", 2nd ed., 2012, (4-28c); the power falls twice as fast as
// the field.
Material::Material(double relative_permittivity, double conductivity_spm, double carrier_hz) {
    const double omega = 2 * pi * carrier_hz;
    const double loss_tangent = conductivity_spm / (omega * vacuum_permittivity * relative_permittivity);
    // √(1 + t²) - 1, without cancellation.
    const double excess = loss_tangent * loss_tangent / (std::hypot(1, loss_tangent) + 1);
    const double wave_number = omega * std::sqrt(relative_permittivity) / speed_of_light_mps;
    power_attenuation_per_m_ = 2 * wave_number * std::sqrt(excess / 2);
    permittivity_ = {relative_permittivity, -loss_tangent * relative_permittivity};
}

double Material::gain_through(double length_m) const {
    return std::exp(-power_attenuation_per_m_ * length_m);
}

// Fresnel's coefficients for a wave from air: ITU-R P.2040-3, (31a) and (31b). From inside, at the
// corresponding angle, the same share is reflected (reciprocity).
double Material::gain_at_face(double cosine) const {
    const double squared_sine = (1 - cosine) * (1 + cosine);
    const std::complex<double> root = std::sqrt(permittivity_ - squared_sine);
    const std::complex<double> across = (cosine - root) / (cosine + root);
    const std::complex<double> along = (permittivity_ * cosine - root) / (permittivity_ * cosine + root);
    return std::clamp(1 - (std::norm(across) + std::norm(along)) / 2, 0.0, 1.0);
}

Material make_material(const ObstacleConfig& config, double carrier_hz) {
    check_name("obstacle.material", config.material, material_names);
    const Fit& fit = *std::find_if(fits.begin(), fits.end(),
                                   [&config](const Fit& other) { return other.name == config.material; });
    const double carrier_ghz = carrier_hz / 1e9;
    return {config.relative_permittivity == -1 ? fit.a * std::pow(carrier_ghz, fit.b)
                                               : config.relative_permittivity,
            config.conductivity_spm == -1 ? fit.c * std::pow(carrier_ghz, fit.d) : config.conductivity_spm,
            carrier_hz};
}

}  // namespace netsim
