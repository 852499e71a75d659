// How far any node can have moved: an upper bound that holds for all of them at once.
//
// The reading grows with the speed of the fastest node. Between two instants no node is displaced by more than the
// difference of the readings, so whoever noted positions at one reading knows how wrong they can be at another,
// without an event for each step of a node. Used by the medium and its Neighbours.
#pragma once

#include <cstdint>
#include <vector>

#include "netsim/mobility/trajectory.hpp"

namespace netsim {

class Odometer final : private CourseListener {
public:
    // The trajectory must outlive the odometer, or change no more after it.
    void watch(const Trajectory& trajectory, SimTime now);

    // In m. `now` may not be before the latest change of a course.
    double reading_m(SimTime now) const {
        return now <= since_ ? reading_m_ : reading_m_ + fastest_mps_ * (now - since_).seconds();
    }
    // Nobody moves, and nobody will before the next change of a course.
    bool all_stand() const { return fastest_mps_ == 0; }
    std::uint64_t course_changes() const { return course_changes_; }
    // Finds out who is the fastest by now; so far the fastest since the last time counted. O(nodes).
    void renew(SimTime now);

private:
    void course_changed(SimTime now, double speed_mps) override;
    void advance(SimTime now);

    std::vector<const Trajectory*> trajectories_;
    SimTime since_ = SimTime::long_ago();
    double reading_m_ = 0;  // at `since_`
    double fastest_mps_ = 0;
    std::uint64_t course_changes_ = 0;
};

}  // namespace netsim
