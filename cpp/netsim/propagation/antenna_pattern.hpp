// An antenna as the medium sees it: its gain over an isotropic antenna in a direction, and its
// orientation. The patterns are in phy/antenna.hpp.
#pragma once

#include "netsim/mobility/attitude.hpp"

namespace netsim {

class AntennaPattern {
public:
    virtual ~AntennaPattern() = default;

    // Linear ratio ≥ 0. `direction`, of any length but 0, is in the antenna's frame, whose x axis
    // is the boresight.
    virtual double gain(const Position& direction) const = 0;
    // The largest gain of all directions.
    virtual double max_gain() const = 0;
};

// An antenna on a node. Without a pattern, it is isotropic and costs nothing.
struct MountedAntenna {
    const AntennaPattern* pattern = nullptr;  // must outlive the medium's use of it
    Attitude attitude;                        // of the node
    Orientation offset;                       // of the antenna, relative to the node

    double max_gain() const { return pattern == nullptr ? 1 : pattern->max_gain(); }

    // The gain towards `direction`, in the scene, at `time` on `trajectory`, the node's. The
    // largest gain if two nodes are at one place, where there is no direction.
    double gain_towards(const Position& direction, const Trajectory& trajectory, SimTime time) const {
        if (pattern == nullptr) {
            return 1;
        }
        constexpr double nearest_m2 = 1e-18;
        if (dot_product(direction, direction) < nearest_m2) {
            return pattern->max_gain();
        }
        return pattern->gain(offset.to_own(attitude.at(trajectory, time).to_own(direction)));
    }
};

}  // namespace netsim
