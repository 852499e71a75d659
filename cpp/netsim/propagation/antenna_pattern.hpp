// What the medium must know of an antenna: how much more, or less, it sends to and receives from a direction than an
// isotropic one would, and how it is turned. The patterns themselves are the phy's (phy/antenna.hpp).
#pragma once

#include "netsim/mobility/attitude.hpp"

namespace netsim {

class AntennaPattern {
public:
    virtual ~AntennaPattern() = default;

    // Linear ratio ≥ 0. `direction`, of any length but 0, is seen from the antenna, whose boresight is its x axis.
    virtual double gain(const Position& direction) const = 0;
    // In no direction is the gain larger.
    virtual double max_gain() const = 0;
};

// An antenna on a node. Without a pattern it is isotropic, and costs nothing.
struct MountedAntenna {
    const AntennaPattern* pattern = nullptr;  // must outlive the medium's use of it
    Attitude attitude;                        // of the node
    Orientation offset;                       // of the antenna, seen from the node

    double max_gain() const { return pattern == nullptr ? 1 : pattern->max_gain(); }

    // Towards `direction`, in the scene, at `time` on `trajectory`, the node's. Where two nodes are at one place there is
    // no direction: then the largest gain.
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
