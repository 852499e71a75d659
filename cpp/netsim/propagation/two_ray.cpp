#include "netsim/propagation/two_ray.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>

#include "netsim/units.hpp"

namespace netsim {

TwoRay::TwoRay(const MediumConfig& config)
    : alpha_(config.alpha),
      epsilon_r_(config.epsilon_r),
      is_vertical_(config.polarization == "vertical"),
      sign_(is_vertical_ && config.inet_vertical_sign ? -1 : 1) {
    constexpr Factory<Kind> kinds[] = {
        {"TwoRayGroundReflection", Kind::ground_reflection},
        {"TwoRayInterference", Kind::interference},
    };
    static_assert(makes_all(kinds, path_losses | std::views::filter(has_ground)));
    const Model& model = model_named(config.path_loss, path_losses);
    kind_ = has_ground(model) ? factory_of(model.name, kinds) : Kind::none;
}

double TwoRay::gain(const Position& a, const Position& b, double distance_m, double carrier_hz) const {
    if (distance_m == 0) {
        return 1;
    }
    constexpr double pi = std::numbers::pi;
    const double wavelength_m = speed_of_light_mps / carrier_hz;
    const double heights_m2 = std::abs(a.z * b.z);
    const double squared_m2 = distance_m * distance_m;
    if (kind_ == Kind::ground_reflection && distance_m * wavelength_m >= 4 * pi * heights_m2) {
        const double root = heights_m2 / squared_m2;
        return std::min(root * root, 1.0);
    }
    if (kind_ == Kind::ground_reflection) {
        return direct_gain(distance_m, carrier_hz);
    }
    const double at_one_metre = wavelength_m * wavelength_m / (16 * pi * pi);
    return std::min(at_one_metre / squared_m2 * interference_factor(a, b, distance_m, wavelength_m), 1.0);
}

double TwoRay::direct_gain(double distance_m, double carrier_hz) const {
    constexpr double pi = std::numbers::pi;
    const double wavelength_m = speed_of_light_mps / carrier_hz;
    const double at_one_metre = wavelength_m * wavelength_m / (16 * pi * pi);
    const double exponent = kind_ == Kind::ground_reflection ? alpha_ : 2;
    const double divisor = exponent == 2 ? distance_m * distance_m : std::pow(distance_m, exponent);
    return std::min(at_one_metre / divisor, 1.0);
}

double TwoRay::interference_factor(const Position& a, const Position& b, double distance_m,
                                   double wavelength_m) const {
    const double a_m = std::abs(a.z);
    const double b_m = std::abs(b.z);
    const double heights_m = a_m + b_m;
    const double squared_ground_m2 = (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
    const double reflected_m = std::sqrt(squared_ground_m2 + heights_m * heights_m);
    // d' − d = (d'² − d²) / (d' + d), to avoid cancellation.
    const double detour_m = (heights_m * heights_m - (a.z - b.z) * (a.z - b.z)) / (reflected_m + distance_m);
    const double phase = 2 * std::numbers::pi * detour_m / wavelength_m;
    const double sine = heights_m / reflected_m;
    const double squared_cosine = squared_ground_m2 / (reflected_m * reflected_m);
    const double bent = std::sqrt(std::max(epsilon_r_ - squared_cosine, 0.0));
    const double straight = is_vertical_ ? epsilon_r_ * sine : sine;
    if (straight + bent == 0) {
        return 1;  // ε = 1: nothing reflects
    }
    const double reflection = sign_ * (straight - bent) / (straight + bent);
    return std::max(1 + reflection * (reflection + 2 * std::cos(phase)), 0.0);
}

}  // namespace netsim
