#include "netsim/propagation/path_loss.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <ranges>

#include "netsim/config/check.hpp"
#include "netsim/units.hpp"

namespace netsim {

double PathLoss::reach_m(double gain, double carrier_hz) const {
    if (gain > 1) {
        return 0;
    }
    if (gain <= 0) {
        return std::numeric_limits<double>::infinity();
    }
    const double factor = wavelength_factor(carrier_hz);
    const auto reach_of = [&](const PowerLaw& law) {
        const double ratio = law.coefficient * factor / gain;
        return law.exponent == 2 ? std::sqrt(ratio) : std::pow(ratio, 1 / law.exponent);
    };
    const double breakpoint_m = std::sqrt(squared_breakpoint_m2_);
    const double far_reach_m = reach_of(far_);
    // The two laws need not meet at the breakpoint: the far one may still reach where the near one
    // does not.
    return far_reach_m >= breakpoint_m ? far_reach_m : std::min(reach_of(near_), breakpoint_m);
}

namespace {

using Carrier = PathLoss::Carrier;

constexpr double friis = 1 / (16 * std::numbers::pi * std::numbers::pi);

PathLoss free_space(const MediumConfig& config) {
    return {{.coefficient = friis / config.system_loss, .exponent = config.alpha},
            Carrier::squared_wavelength};
}

PathLoss breakpoint(const MediumConfig& config) {
    const double at_breakpoint = ratio_from_db(-config.l02_db);
    return {{.coefficient = ratio_from_db(-config.l01_db), .exponent = config.alpha1},
            {.coefficient = at_breakpoint * std::pow(config.breakpoint_distance_m, config.alpha2),
             .exponent = config.alpha2},
            config.breakpoint_distance_m,
            Carrier::any};
}

// From its crossover on, the model is below free space of exponent 2.
PathLoss bound_of_ground_reflection(const MediumConfig& config) {
    return {{.coefficient = friis, .exponent = std::max(config.alpha, 2.0)},
            {.coefficient = friis, .exponent = std::min(config.alpha, 2.0)},
            1,
            Carrier::squared_wavelength};
}

// Two rays of equal strength in phase: twice the amplitude.
PathLoss bound_of_interference(const MediumConfig& /*config*/) {
    return {{.coefficient = 4 * friis, .exponent = 2}, Carrier::squared_wavelength};
}

constexpr Factory<PathLoss (*)(const MediumConfig&)> factories[] = {
    {"FreeSpacePathLoss", free_space},
    {"BreakpointPathLoss", breakpoint},
    {"TwoRayGroundReflection", bound_of_ground_reflection},
    {"TwoRayInterference", bound_of_interference},
};
static_assert(makes_all(factories, path_losses | std::views::filter(std::not_fn(is_random))));

}  // namespace

PathLoss make_path_loss(const MediumConfig& config) {
    check_name("medium.path_loss", config.path_loss, path_loss_names);
    const Model& model = model_named(config.path_loss, path_losses);
    return is_random(model) ? free_space(config) : factory_of(model.name, factories)(config);
}

}  // namespace netsim
