// An upper bound for the displacement of any node, shared by all nodes.
//
// The total grows with the speed of the fastest node. Between two instants, no node moves farther
// than the difference of the totals. So the error of stored positions is bounded without an event
// per node. Used by the medium and its NeighborSearch.
#pragma once

#include <cstdint>
#include <vector>

#include "netsim/mobility/trajectory.hpp"

namespace netsim {

class DisplacementBound final : private CourseListener {
public:
    // The trajectory must outlive this object, or not change after this object is destroyed.
    void watch(const Trajectory& trajectory, SimTime now);

    // Bound in m for the path length of any node so far. `now` must not be before the latest course
    // change.
    double total_m(SimTime now) const {
        return now <= since_ ? total_m_ : total_m_ + fastest_mps_ * (now - since_).seconds();
    }
    // Whether no node moves now and until the next course change.
    bool all_stand() const { return fastest_mps_ == 0; }
    std::uint64_t course_changes() const { return course_changes_; }
    // Updates the speed of the fastest node. Between calls, the bound uses the highest speed since
    // the last call. O(nodes).
    void refresh(SimTime now);

private:
    void course_changed(SimTime now, double speed_mps) override;
    void advance(SimTime now);

    std::vector<const Trajectory*> trajectories_;
    SimTime since_ = SimTime::long_ago();
    double total_m_ = 0;  // at `since_`
    double fastest_mps_ = 0;
    std::uint64_t course_changes_ = 0;
};

}  // namespace netsim
