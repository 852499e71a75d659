#include "netsim/mobility/path_mobility.hpp"

#include <algorithm>
#include <cmath>

namespace netsim {

SimTime PathMobility::begin_leg(SimTime now) {
    // Two turns that are closer are one: legs take time at any speed.
    constexpr SimTime shortest = SimTime::from_us(1);
    const SimTime end_of_time = SimTime::from_seconds(SimTime::longest_run_s);
    if (end_of_time - now <= shortest) {
        return SimTime::never();
    }
    const double turn_s = path_->next_turn_s((now + shortest).seconds());
    if (std::isinf(turn_s)) {
        return SimTime::never();
    }
    const SimTime arrival = std::min(SimTime::of_event(turn_s), end_of_time);
    trajectory_.move(now, path_->at(arrival.seconds()), arrival);
    return arrival;
}

}  // namespace netsim
