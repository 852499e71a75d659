// The orientation of a node as a function of time. There are no events for it; it is computed on
// demand.
//
// It is either constant, or the node faces forward: heading and elevation follow the direction in
// which it moves or last moved, without bank, as in INET's mobility.faceForward.
#pragma once

#include "netsim/config/mobility_config.hpp"
#include "netsim/geometry/orientation.hpp"
#include "netsim/mobility/trajectory.hpp"

namespace netsim {

class Attitude {
public:
    // Without rotation.
    Attitude() = default;
    explicit Attitude(const MobilityConfig& config)
        : initial_(config.initial_orientation), faces_forward_(config.face_forward) {}

    // `trajectory`: of the node. `time`: as for its position_at.
    Orientation at(const Trajectory& trajectory, SimTime time) const {
        if (!faces_forward_) {
            return initial_;
        }
        const Position course = trajectory.course_at(time);
        return course == Position{} ? initial_ : Orientation::facing(course);
    }

private:
    Orientation initial_;
    bool faces_forward_ = false;
};

}  // namespace netsim
