#include "netsim/mobility/quadcopter_mobility.hpp"

namespace netsim {

void QuadcopterMobility::fly(SimTime now, SimTime until) {
    vehicle_.step(position_error());
    trajectory_.move(now, vehicle_.position(), until);
}

}  // namespace netsim
