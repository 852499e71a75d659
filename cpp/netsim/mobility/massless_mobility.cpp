#include "netsim/mobility/massless_mobility.hpp"

namespace netsim {

void MasslessMobility::go_to(SimTime now, Position target) {
    check_target(target);
    target_ = target;
    trajectory_.go_to(now, target, speed_mps_);
}

void MasslessMobility::set_speed(SimTime now, double speed_mps) {
    check_speed(speed_mps);
    speed_mps_ = speed_mps;
    if (target_) {
        trajectory_.go_to(now, *target_, speed_mps_);
    }
}

}  // namespace netsim
