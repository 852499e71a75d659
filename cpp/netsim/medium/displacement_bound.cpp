#include "netsim/medium/displacement_bound.hpp"

#include <algorithm>

namespace netsim {

void DisplacementBound::watch(const Trajectory& trajectory, SimTime now) {
    trajectories_.push_back(&trajectory);
    trajectory.set_listener(*this);
    course_changed(now, trajectory.speed_mps(now));
}

void DisplacementBound::refresh(SimTime now) {
    advance(now);
    fastest_mps_ = 0;
    for (const Trajectory* trajectory : trajectories_) {
        fastest_mps_ = std::max(fastest_mps_, trajectory->speed_mps(now));
    }
}

void DisplacementBound::course_changed(SimTime now, double speed_mps) {
    advance(now);
    ++course_changes_;
    fastest_mps_ = std::max(fastest_mps_, speed_mps);
}

void DisplacementBound::advance(SimTime now) {
    if (now > since_) {
        total_m_ = total_m(now);
        since_ = now;
    }
}

}  // namespace netsim
