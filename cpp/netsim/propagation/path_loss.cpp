#include "netsim/propagation/path_loss.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "netsim/config/check.hpp"
#include "netsim/error.hpp"
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

PathLoss make_path_loss(const MediumConfig& config) {
    const std::string& name = config.path_loss;
    check_name("medium.path_loss", name, path_loss_names);
    PathLoss path_loss;
    if (name == "BreakpointPathLoss") {
        path_loss.near_ = {.coefficient = ratio_from_db(-config.l01_db), .exponent = config.alpha1};
        path_loss.far_ = {.coefficient = ratio_from_db(-config.l02_db) *
                                         std::pow(config.breakpoint_distance_m, config.alpha2),
                          .exponent = config.alpha2};
        path_loss.squared_breakpoint_m2_ = config.breakpoint_distance_m * config.breakpoint_distance_m;
        return path_loss;
    }
    constexpr double pi = std::numbers::pi;
    path_loss.depends_on_carrier_ = true;
    if (name == "TwoRayInterference") {
        // Two rays of equal strength in phase: twice the amplitude.
        path_loss.near_ = {.coefficient = 4 / (16 * pi * pi), .exponent = 2};
        path_loss.far_ = path_loss.near_;
        return path_loss;
    }
    path_loss.near_ = {.coefficient = 1 / (16 * pi * pi), .exponent = config.alpha};
    path_loss.far_ = path_loss.near_;
    if (name == "TwoRayGroundReflection") {
        // From its crossover on it is below free space of exponent 2.
        path_loss.near_.exponent = std::max(config.alpha, 2.0);
        path_loss.far_.exponent = std::min(config.alpha, 2.0);
        path_loss.squared_breakpoint_m2_ = 1;
        return path_loss;
    }
    path_loss.near_.coefficient /= config.system_loss;
    path_loss.far_ = path_loss.near_;
    NETSIM_ASSERT(name == "FreeSpacePathLoss" || std::ranges::find(fading_names, name) != fading_names.end());
    return path_loss;
}

}  // namespace netsim
