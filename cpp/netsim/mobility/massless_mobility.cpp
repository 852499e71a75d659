#include "netsim/mobility/massless_mobility.hpp"

namespace netsim {

void MasslessMobility::turn_to(SimTime now, Position target) {
    target_ = target;
    trajectory_.go_to(now, target, speed_mps_);
}

void MasslessMobility::change_speed(SimTime now, double speed_mps) {
    speed_mps_ = speed_mps;
    if (target_) {
        trajectory_.go_to(now, *target_, speed_mps_);
    }
}

}  // namespace netsim
