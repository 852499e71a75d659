#include "netsim/mobility/massless_mobility.hpp"

#include <cmath>
#include <string>

#include "netsim/error.hpp"

namespace netsim {

void MasslessMobility::go_to(SimTime now, Position target) {
    if (!is_in_scene(target)) {
        throw SimulationError("cannot go to (" + std::to_string(target.x) + ", " + std::to_string(target.y) +
                              ", " + std::to_string(target.z) +
                              "): expected three numbers of meters, each from -1e7 to 1e7");
    }
    target_ = target;
    trajectory_.go_to(now, target, speed_mps_);
}

void MasslessMobility::set_speed(SimTime now, double speed_mps) {
    if (!std::isfinite(speed_mps) || speed_mps < 0) {
        throw SimulationError("cannot fly at " + std::to_string(speed_mps) +
                              " m/s: expected a finite speed of at least 0 m/s");
    }
    speed_mps_ = speed_mps;
    if (target_) {
        trajectory_.go_to(now, *target_, speed_mps_);
    }
}

}  // namespace netsim
