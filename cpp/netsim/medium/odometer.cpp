#include "netsim/medium/odometer.hpp"

#include <algorithm>

namespace netsim {

void Odometer::watch(const Trajectory& trajectory, SimTime now) {
    trajectories_.push_back(&trajectory);
    trajectory.set_listener(*this);
    course_changed(now, trajectory.speed_mps(now));
}

void Odometer::renew(SimTime now) {
    advance(now);
    fastest_mps_ = 0;
    for (const Trajectory* trajectory : trajectories_) {
        fastest_mps_ = std::max(fastest_mps_, trajectory->speed_mps(now));
    }
}

void Odometer::course_changed(SimTime now, double speed_mps) {
    advance(now);
    ++course_changes_;
    fastest_mps_ = std::max(fastest_mps_, speed_mps);
}

void Odometer::advance(SimTime now) {
    if (now > since_) {
        reading_m_ = reading_m(now);
        since_ = now;
    }
}

}  // namespace netsim
