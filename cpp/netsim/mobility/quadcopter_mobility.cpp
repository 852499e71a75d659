#include "netsim/mobility/quadcopter_mobility.hpp"

namespace netsim {

void QuadcopterMobility::go_to(SimTime, Position target) {
    check_target(target);
    vehicle_.go_to(target);
}

void QuadcopterMobility::set_speed(SimTime, double speed_mps) {
    check_speed(speed_mps);
    vehicle_.set_speed(speed_mps);
}

void QuadcopterMobility::fly(SimTime now, SimTime until) {
    vehicle_.step(position_error());
    trajectory_.move(now, vehicle_.position(), until);
}

}  // namespace netsim
