// How a node is turned, as a formula of time: no event turns a node, whoever needs its orientation asks for it.
//
// Either it stays as it was at the start, or it faces forward: its heading and elevation follow the direction in which
// it moves or last moved, without bank, as in INET's mobility.faceForward.
#pragma once

#include "netsim/config/mobility_config.hpp"
#include "netsim/geometry/orientation.hpp"
#include "netsim/mobility/trajectory.hpp"

namespace netsim {

class Attitude {
public:
    // Not turned.
    Attitude() = default;
    explicit Attitude(const MobilityConfig& config)
        : initial_(config.initial_orientation), faces_forward_(config.face_forward) {}

    // `trajectory` is that of the node; times as for its position_at.
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
